#include "common/config/deploy_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "common/config/config.hpp"
#include "common/config/nearest_name.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr auto kExtension = ".txtpb";

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

Names known_profiles(const fs::path& folder) {
  Names names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

fs::path find_deploy_folder(const DeploySearch& search) {
  if (search.longreach_home && !search.longreach_home->empty()) {
    const fs::path home = *search.longreach_home;
    if (is_deploy_folder(home)) return home;
    throw ConfigError(
        "LONGREACH_HOME = " + home.string() +
        " holds none of the folders config, links, devices, robots, scenes; set it to the deploy folder");
  }
  if (const auto folder = nearest_above(search.program_folder)) return *folder;
  if (const auto folder = nearest_above(search.working_folder)) return *folder;
  throw ConfigError(
      "no deploy folder above " + search.program_folder.string() + " or " + search.working_folder.string() +
      "; set LONGREACH_HOME to the folder that holds config, links, devices, robots and scenes");
}

fs::path find_deploy_folder() {
  DeploySearch search;
  if (const char* home = std::getenv("LONGREACH_HOME")) search.longreach_home = home;
  std::error_code ignored;
  search.program_folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  search.working_folder = fs::current_path(ignored);
  return find_deploy_folder(search);
}

proto::LinkProfile load_link_profile(const fs::path& deploy_folder, const std::string& name) {
  const fs::path folder = deploy_folder / "links";
  const bool plain = !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos &&
                     name.find('\0') == std::string::npos;
  const bool path =
      name.starts_with('/') && name.ends_with(kExtension) && name.find('\0') == std::string::npos;
  if (!plain && !path) {
    throw ConfigError("\"" + name + "\" is not the name of a link profile; give a plain name, one of: " +
                      list_names(known_profiles(folder)) + ", or the absolute path of a " + kExtension +
                      " file");
  }
  const fs::path file = path ? fs::path(name) : folder / (name + kExtension);
  std::error_code ignored;
  if (!path && !fs::exists(file, ignored)) {
    const Names known = known_profiles(folder);
    throw ConfigError("there is no link profile \"" + name + "\" in " + folder.string() +
                      instead_of(name, known, "known"));
  }
  proto::LinkProfile profile;
  load_text_file(file, profile);
  if (profile.name().empty()) profile.set_name(name);
  return profile;
}

}  // namespace longreach
