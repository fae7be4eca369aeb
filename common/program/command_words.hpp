#pragma once
// The words of a command line, as completion and manual page need them: a tree of commands, flattened.

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace longreach {

struct OptionWords {
  std::vector<std::string> names;    // with their dashes; of a positional: none
  std::string what;                  // its value: FILE, HOST:PORT, ...; empty: it has none
  std::vector<std::string> choices;  // values; empty: anything
  std::string help;
};

struct CommandWords {
  std::vector<std::string> path;  // below the program; empty: itself
  std::string help, footer;
  std::vector<OptionWords> options, positionals;
  std::vector<std::string> commands;
  bool inherits = false;  // options of the commands above may stand behind it, too
};

/// The program first, each command before its own.
std::vector<CommandWords> command_words(const CLI::App& app);

std::string joined(const std::vector<std::string>& words, const char* between = " ");

}  // namespace longreach
