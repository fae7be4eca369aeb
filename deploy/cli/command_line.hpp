#pragma once
// Parses the command line into an Invocation, or into the help or version text to print.

#include <optional>
#include <string>
#include <variant>

#include "deploy/cli/invocation.hpp"

namespace longreach {

/// Help or version text that is printed instead of running a command.
struct Printout {
  std::string text;
  ExitStatus exit = ExitStatus::kDone;
};

/// Throws UsageError or ConfigError.
std::variant<Invocation, Printout> parse_command_line(int argc, const char* const* argv);

}  // namespace longreach
