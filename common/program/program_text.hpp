#pragma once
// Manual page and shell completion of a program, from the same texts as its --help.

#include <CLI/App.hpp>
#include <string>

namespace longreach {

/// Adds --man and --completion SHELL, which print and exit. `title`: name and version of the program.
void add_manual_options(CLI::App& app, const std::string& title);

/// Roff, for `man`. `title`: name and version of the program.
std::string manual_page(const CLI::App& app, const std::string& title);

/// `shell`: bash, zsh or fish.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace longreach
