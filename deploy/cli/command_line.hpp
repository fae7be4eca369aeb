#pragma once
// Parses the command line to an Invocation; help and version texts.

#include <optional>
#include <string>
#include <variant>

#include "deploy/cli/invocation.hpp"

namespace longreach {

/// Text to print instead of carrying out a command: help or version.
struct Printout {
  std::string text;
  ExitStatus exit = ExitStatus::kDone;
};

/// Throws UsageError or ConfigError.
std::variant<Invocation, Printout> parse_command_line(int argc, const char* const* argv);

}  // namespace longreach
