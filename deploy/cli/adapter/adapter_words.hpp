#pragma once
// Parses the command-line arguments of `adapter`.

#include <CLI/CLI.hpp>
#include <string>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class AdapterWords {
 public:
  /// Adds the command `adapter` with its subcommand.
  void declare(CLI::App& app);
  /// Returns the parsed command. Call this only if `adapter` was given. Throws UsageError.
  [[nodiscard]] AdapterCheckCommand command() const;

 private:
  std::string device_, robot_, force_ = "0.5", move_ = "0";
  std::string device_file_, robot_file_, push_timeout_ = "30";
  bool push_ = false;
};

}  // namespace longreach
