#include "common/recording/recording_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <ctime>

#include "common/recording/recording_error.hpp"

namespace longreach {
namespace {

constexpr std::size_t kNameMax = 100;

bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= kNameMax && name.front() != '.' && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

}  // namespace

void check_recording_name(const std::string& name) {
  constexpr std::size_t kShown = 40;
  if (is_name(name)) return;
  throw RecordingError("'" + (name.size() > kShown ? name.substr(0, kShown) + "..." : name) +
                       "' is not a valid recording name: use at most " + std::to_string(kNameMax) +
                       " characters (letters, digits, '.', '_' or '-'), and do not begin with '.' or '-'");
}

std::filesystem::path default_recordings() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return std::filesystem::path(state) / "longreach" / "recordings";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/')
    throw RecordingError("there is no folder for recordings: set HOME, or use --recordings DIR");
  return std::filesystem::path(home) / ".local" / "state" / "longreach" / "recordings";
}

std::filesystem::path recording_path(const std::filesystem::path& folder, const std::string& name,
                                     const std::string& side) {
  check_recording_name(name);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RecordingError("cannot create the folder " + folder.string() + ": " + error.message());
  return folder / (name + "-" + side + ".mcap");
}

std::string recording_name_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%SZ", &parts);
  return text.data();
}

}  // namespace longreach
