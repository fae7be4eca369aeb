#pragma once
// What a program's command line is to others, from the same words as its --help: the manual page, and the
// completion of shells.

#include <CLI/App.hpp>
#include <string>

namespace longreach {

/// Adds --man and --completion SHELL, which print and end. `title`: the program's name and version.
void add_manual_options(CLI::App& app, const std::string& title);

/// Roff, for `man`. `title`: the program's name and version.
std::string manual_page(const CLI::App& app, const std::string& title);

/// `shell`: bash, zsh or fish.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace longreach
