// longreach demo: replaces this process with the script of the installation that runs both programs.

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/config/deploy_folder.hpp"
#include "common/recording/recording_folder.hpp"
#include "deploy/cli/commands.hpp"

namespace longreach {

ExitStatus run_demo(const DemoCommand& command) {
  namespace fs = std::filesystem;
  const auto installed = installed_folder();
  const fs::path script = installed.value_or(fs::path()) / "libexec" / "run-demo";
  std::error_code ignored;
  if (!installed || !fs::exists(script, ignored))
    throw UsageError(
        "demo needs share/longreach/libexec/run-demo next to the installed programs; "
        "install longreach");
  const fs::path logs =
      command.logs.empty() ? default_recordings().parent_path() / "demo" : fs::path(command.logs);
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<std::string> words{script.string(), "--bin", programs.string(), "--logs", logs.string()};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(script.c_str(), arguments.data());
  throw UsageError(script.string() + " cannot be started: " + std::strerror(errno));
}

}  // namespace longreach
