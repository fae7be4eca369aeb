#include "common/config/deploy_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

// A folder that is only called `deploy` (of a build, say) holds none of these.
bool is_deploy_folder(const fs::path& folder) {
  constexpr std::array<const char*, 5> kParts{"config", "links", "devices", "robots", "scenes"};
  std::error_code ignored;
  return std::ranges::any_of(kParts,
                             [&](const char* part) { return fs::is_directory(folder / part, ignored); });
}

std::optional<fs::path> nearest_above(const fs::path& start) {
  for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
    // In the source tree, and installed.
    for (const char* name : {"deploy", "share/longreach"}) {
      if (is_deploy_folder(folder / name)) return folder / name;
    }
    if (folder == folder.parent_path()) break;
  }
  return std::nullopt;
}

}  // namespace

fs::path find_deploy_folder(const DeploySearch& search) {
  if (search.longreach_home && !search.longreach_home->empty()) {
    const fs::path home = *search.longreach_home;
    if (is_deploy_folder(home)) return home;
    throw ConfigError(
        "LONGREACH_HOME = " + home.string() +
        " contains none of the folders config, links, devices, robots, scenes; set it to the deploy folder");
  }
  if (const auto folder = nearest_above(search.program_folder)) return *folder;
  if (const auto folder = nearest_above(search.working_folder)) return *folder;
  throw ConfigError(
      "there is no deploy folder above " + search.program_folder.string() + " or " +
      search.working_folder.string() +
      "; set LONGREACH_HOME to the folder that contains config, links, devices, robots and scenes");
}

namespace {

DeploySearch present_search() {
  DeploySearch search;
  if (const char* home = std::getenv("LONGREACH_HOME")) search.longreach_home = home;
  std::error_code ignored;
  search.program_folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  search.working_folder = fs::current_path(ignored);
  return search;
}

}  // namespace

fs::path find_deploy_folder() { return find_deploy_folder(present_search()); }

std::optional<fs::path> installed_folder() {
  const DeploySearch search = present_search();
  if (const auto folder = nearest_above(search.program_folder)) return folder;
  return nearest_above(search.working_folder);
}

proto::LinkProfile load_link_profile(const fs::path& deploy_folder, const std::string& name) {
  return load_link_profile(FileSearch({deploy_folder}), name);
}

}  // namespace longreach
