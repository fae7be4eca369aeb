#pragma once
// The commands and options of a program as a flat list, for shell completion and the manual page.

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace longreach {

struct OptionWords {
  std::vector<std::string> names;  // including the dashes; empty for a positional argument
  std::string what;  // placeholder of its value, such as FILE or HOST:PORT; empty if it has no value
  std::vector<std::string> choices;  // allowed values; empty if any value is allowed
  std::string help;
};

struct CommandWords {
  std::vector<std::string> path;  // command and subcommands; empty for the program itself
  std::string help, footer;
  std::vector<OptionWords> options, positionals;
  std::vector<std::string> commands;
  bool inherits = false;  // the command also accepts the options of its parents
};

/// Returns the program first, and each command before its subcommands.
std::vector<CommandWords> command_words(const CLI::App& app);

std::string joined(const std::vector<std::string>& words, const char* between = " ");

}  // namespace longreach
