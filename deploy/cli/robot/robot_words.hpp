#pragma once
// Parses the command-line arguments of `robot`.

#include <CLI/CLI.hpp>
#include <string>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class RobotWords {
 public:
  /// Adds the command `robot` with its subcommands.
  void declare(CLI::App& app);
  /// Returns the parsed command. Call this only if `robot` was given.
  [[nodiscard]] RobotCommand command() const;

 private:
  CLI::App* robot_ = nullptr;
  std::string file_, base_link_, tip_link_, picture_, form_;
};

}  // namespace longreach
