#pragma once
// The part of the command line that is about robot files.

#include <CLI/CLI.hpp>
#include <string>

#include "deploy/cli/invocation.hpp"

namespace longreach {

class RobotWords {
 public:
  /// Adds `robot` with its commands.
  void declare(CLI::App& app);
  /// What was asked for, where `robot` was.
  [[nodiscard]] RobotCommand command() const;

 private:
  CLI::App* robot_ = nullptr;
  std::string file_, base_link_, tip_link_, picture_, form_;
};

}  // namespace longreach
