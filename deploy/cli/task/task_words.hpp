#pragma once
// Parses the command-line arguments of `task`.

#include <CLI/CLI.hpp>
#include <string>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class TaskWords {
 public:
  /// Adds the command `task` with its subcommands.
  void declare(CLI::App& app);
  /// Returns the parsed command. Call this only if `task` was given. Throws UsageError.
  [[nodiscard]] TaskCommand command() const;

 private:
  CLI::App* task_ = nullptr;
  std::string participant_, csv_, trial_, limit_ = "600";
  std::string modes_ = "rate,position,hybrid", links_ = "lab,analog,moon", trials_ = "2";
};

}  // namespace longreach
