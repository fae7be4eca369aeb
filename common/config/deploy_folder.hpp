#pragma once
// Finds the folder with the files that a user edits.

#include <filesystem>
#include <optional>
#include <string>

namespace longreach {

/// Inputs of find_deploy_folder().
struct DeploySearch {
  std::optional<std::string> longreach_home;  // the environment variable
  std::filesystem::path program_folder;       // folder of the running program
  std::filesystem::path working_folder;
};

/// Throws ConfigError if there is no such folder.
std::filesystem::path find_deploy_folder(const DeploySearch& search);

/// Returns the nearest `deploy` or `share/longreach` folder next to or above the program, otherwise the
/// nearest one above the working folder.
std::optional<std::filesystem::path> installed_folder();

}  // namespace longreach
