#pragma once
// Generates the manual page and shell completion of a program from the text of its --help.

#include <CLI/App.hpp>
#include <string>

namespace longreach {

/// Adds the options --man and --completion SHELL, which print the text and exit. `title` is the name and
/// version of the program.
void add_manual_options(CLI::App& app, const std::string& title);

/// Returns the manual page in roff format. `title` is the name and version of the program.
std::string manual_page(const CLI::App& app, const std::string& title);

/// Returns the completion script for `shell`: bash, zsh or fish.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace longreach
