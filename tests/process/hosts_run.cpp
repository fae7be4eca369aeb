#include "tests/process/hosts_run.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> arguments(const std::vector<std::string>& options, const std::string& log) {
  std::vector<std::string> words{"--bin", LONGREACH_BIN, "--view", "plain", "--log", log};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

std::filesystem::path log_file() {
  static int count = 0;
  return std::filesystem::temp_directory_path() /
         ("longreach-hosts-" + std::to_string(getpid()) + "-" + std::to_string(++count) + ".log");
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

}  // namespace

HostsRun::HostsRun(const std::vector<std::string>& options)
    : log_(log_file()),
      script_(std::string(LONGREACH_DEPLOY) + "/hosts", arguments(options, log_.string())) {}

bool HostsRun::up() { return shows("master start ", std::chrono::seconds(30)); }

bool HostsRun::shows(const std::string& text, std::chrono::seconds timeout, int times) {
  const auto deadline = Clock::now() + timeout;
  while (count(output(), text) < times) {
    if (Clock::now() >= deadline || !script_.running()) return count(output(), text) >= times;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

std::unique_ptr<RunningProgram> HostsRun::client(const std::vector<std::string>& command) const {
  // As the script tells a user to: nsenter ... longreach ... status.
  const std::string said = output();
  const auto at = said.find("  nsenter ");
  std::istringstream line(at == std::string::npos ? "" : said.substr(at, said.find('\n', at) - at));
  std::vector<std::string> words;
  for (std::string word; line >> word && word != "status";) words.push_back(word);
  if (words.empty()) words.emplace_back("nsenter");
  words.insert(words.end(), command.begin(), command.end());
  return std::make_unique<RunningProgram>("/usr/bin/" + words.front(),
                                          std::vector<std::string>(words.begin() + 1, words.end()));
}

int HostsRun::holder() const {
  const std::string said = output();
  const std::string before = "--target ";
  const auto at = said.find(before);
  return at == std::string::npos ? 0 : std::stoi(said.substr(at + before.size()));
}

std::string HostsRun::log() const {
  std::ifstream in(log_);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace longreach
