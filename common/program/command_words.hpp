#pragma once
// The commands and options of a program, for completion and manual page: a tree of commands, flattened.

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace longreach {

struct OptionWords {
  std::vector<std::string> names;    // with their dashes; empty for a positional
  std::string what;                  // its value: FILE, HOST:PORT, ...; empty: none
  std::vector<std::string> choices;  // values; empty: anything
  std::string help;
};

struct CommandWords {
  std::vector<std::string> path;  // path of commands; empty: the program itself
  std::string help, footer;
  std::vector<OptionWords> options, positionals;
  std::vector<std::string> commands;
  bool inherits = false;  // the options of parent commands are accepted as well
};

/// The program first, each command before its subcommands.
std::vector<CommandWords> command_words(const CLI::App& app);

std::string joined(const std::vector<std::string>& words, const char* between = " ");

}  // namespace longreach
