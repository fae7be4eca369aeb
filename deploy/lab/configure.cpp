#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/config/link_profile.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach {

proto::LabConfig configure(const std::vector<std::string>& settings,
                           const std::filesystem::path& deploy_folder, const std::filesystem::path& from) {
  // Settings that select other fields are applied before them.
  const auto chooses = [](std::string_view setting) {
    const std::string_view path = setting.substr(0, setting.find('='));
    return path == "profile" || path.ends_with("accuracy") || path.ends_with("device_file") ||
           path.ends_with("robot_file") || path.ends_with("scene_file");
  };
  const FileSearch search = files_of(deploy_folder);
  proto::LabConfig config;
  for (const std::string& setting : settings) {
    if (chooses(setting)) set_lab_field(config, placed_setting(setting, search, from));
  }
  const proto::LinkProfile profile = load_link_profile(search, config.profile());
  take_profile(*config.mutable_slave()->mutable_link(), profile);
  take_profile(*config.mutable_master()->mutable_link(), profile);
  config.mutable_master()->mutable_safety()->set_engage_at_start(true);
  resolve_files(*config.mutable_master(), search, nullptr);
  resolve_files(*config.mutable_slave(), search, nullptr);
  for (const std::string& setting : settings) {
    if (!chooses(setting)) set_lab_field(config, placed_setting(setting, search, from));
  }
  resolve_files(*config.mutable_slave(), search, nullptr);  // again for the files that the settings changed
  validate(config);
  return config;
}

}  // namespace longreach
