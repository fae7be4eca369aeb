#pragma once
// Where the files that a user edits are.

#include <filesystem>
#include <optional>
#include <string>

namespace longreach {

/// What find_deploy_folder() looks at.
struct DeploySearch {
  std::optional<std::string> longreach_home;  // the environment's variable
  std::filesystem::path program_folder;       // of the running program
  std::filesystem::path working_folder;
};

/// Throws ConfigError.
std::filesystem::path find_deploy_folder(const DeploySearch& search);

/// The nearest `deploy` or `share/longreach` beside or above the program, else above the working folder.
std::optional<std::filesystem::path> installed_folder();

}  // namespace longreach
