#pragma once
// Parses the command-line arguments of `record`.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class RecordWords {
 public:
  /// Adds the command `record` with its subcommands.
  void declare(CLI::App& app);
  /// Returns the parsed command. Call this only if `record` was given. Throws UsageError.
  [[nodiscard]] RecordCommand command() const;

 private:
  CLI::App* record_ = nullptr;
  std::string name_, folder_, max_mb_ = "4096";
  std::vector<std::string> files_;
  bool csv_ = false;
};

}  // namespace longreach
