#include "common/config/file_search.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "common/config/config.hpp"
#include "common/config/deploy_folder.hpp"
#include "common/config/robot/urdf.hpp"
#include "common/text/nearest_name.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".txtpb";

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::string list(const std::vector<fs::path>& folders) {
  std::string text;
  for (std::size_t i = 0; i < folders.size(); ++i)
    text += (i == 0 ? "" : i + 1 == folders.size() ? " or " : ", ") + folders[i].string();
  return text;
}

bool is_path(const std::string& name) { return name.ends_with(kExtension) || is_urdf(name); }

bool is_plain(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos &&
         name.find('\0') == std::string::npos;
}

/// Returns whether `name` is a path or a file with another extension, such as an arm.xml.
bool is_file_of(const std::vector<fs::path>& folders, const std::string& name) {
  if (name.find('.') == std::string::npos) return false;
  return std::ranges::any_of(folders, [&](const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / name, ignored);
  });
}

Names known_in(const std::vector<fs::path>& folders) {
  Names names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (is_path(entry.path().string())) names.push_back(entry.path().stem().string());
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

fs::path working_folder() {
  std::error_code ignored;
  return fs::current_path(ignored);
}

FileSearch FileSearch::first_in(const fs::path& folder) const {
  FileSearch search({folder});
  std::ranges::remove_copy(folders_, std::back_inserter(search.folders_), folder);
  return search;
}

FileSearch FileSearch::beside(const fs::path& file) const {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  return first_in(folder.parent_path()).first_in(folder);
}

fs::path FileSearch::find(std::string_view what, const std::string& name) const {
  if (name.starts_with('/') || folders_.empty()) return name;
  for (const fs::path& folder : folders_) {
    if (is_there(folder / name)) return folder / name;
  }
  throw ConfigError(std::string(what) + " = \"" + name + "\": the file does not exist in " + list(folders_));
}

fs::path FileSearch::find_named(const std::string& what, const std::string& folder,
                                const std::string& name) const {
  if (is_path(name) || is_file_of(folders_, name)) return find(what, name);
  std::vector<fs::path> places;
  for (const fs::path& above : folders_) places.push_back(above / folder);
  if (!is_plain(name))
    throw ConfigError("\"" + name + "\" is not a valid name of a " + what + "; give one of the names " +
                      list_names(known_in(places)) + ", or the path of a " + kExtension +
                      (folder == "robots" ? std::string(" or ") + kUrdfExtension : "") + " file");
  for (const fs::path& place : places) {
    for (const char* extension : {kExtension, kUrdfExtension}) {
      if (const fs::path file = place / (name + extension); is_there(file)) return file;
    }
  }
  throw ConfigError("there is no " + what + " \"" + name + "\" in " + list(places) +
                    instead_of(name, known_in(places), "known"));
}

FileSearch installed_files() { return files_of(find_deploy_folder()); }

FileSearch files_of(const fs::path& folder) {
  std::vector<fs::path> folders{folder};
  if (const auto installed = installed_folder(); installed && *installed != folder)
    folders.push_back(*installed);
  return FileSearch(std::move(folders));
}

std::string placed_setting(const std::string& setting, const FileSearch& search, const fs::path& from) {
  constexpr std::array<std::string_view, 6> kFiles{"robot_file", "scene_file", "device_file",
                                                   "mjcf_file",  "mjcf",       "profile"};
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) return setting;
  const std::string path = setting.substr(0, equals), name = setting.substr(equals + 1);
  const std::string field = path.substr(path.rfind('.') + 1);
  const bool profile = field == "profile";
  if (name.empty() || name.starts_with('/') || std::ranges::find(kFiles, field) == kFiles.end() ||
      (profile && !is_path(name)))
    return setting;
  const fs::path here = fs::absolute(from) / name;
  if (is_there(here)) return path + "=" + here.lexically_normal().string();
  (void)search.first_in(fs::absolute(from).lexically_normal()).find(path, name);
  return setting;
}

proto::LinkProfile load_link_profile(const FileSearch& search, const std::string& name,
                                     std::vector<FileRead>* read) {
  const fs::path file =
      (is_path(name) ? search.first_in(working_folder()) : search).find_named("link profile", "links", name);
  proto::LinkProfile profile;
  load_text_file(file, profile);
  if (read != nullptr) read->push_back({"profile", fs::absolute(file)});
  if (profile.name().empty()) profile.set_name(name);
  return profile;
}

}  // namespace longreach
