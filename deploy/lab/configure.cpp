#include <algorithm>

#include "common/config/config.hpp"
#include "common/config/effective.hpp"
#include "common/config/link_profile.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mjcf_robots.hpp"

namespace longreach {
namespace {

/// The settings of the laboratory itself and of each side.
struct Sorted {
  std::vector<std::string> own;
  std::vector<Setting> master, slave;
};

Sorted sorted(const std::vector<std::string>& settings) {
  constexpr std::string_view kMaster = "master.", kSlave = "slave.";
  Sorted out;
  for (const std::string& text : settings) {
    const auto equals = text.find('=');
    const std::vector<std::string> fields = equals == std::string::npos || equals == 0
                                                ? std::vector<std::string>{}
                                                : lab_fields(text.substr(0, equals));
    const bool both =
        fields.size() > 1 && (fields[0] == "master.loop.rate_hz" || fields[0] == "master.accuracy");
    if (fields.empty() || (fields.size() > 1 && !both)) {
      out.own.push_back(text);  // is refused
      continue;
    }
    for (const std::string& field : fields) {
      const bool of_master = field.starts_with(kMaster), of_slave = field.starts_with(kSlave);
      const std::string value = text.substr(equals);
      if (of_master) out.master.push_back({field.substr(kMaster.size()), both ? field + value : text});
      if (of_slave) out.slave.push_back({field.substr(kSlave.size()), both ? field + value : text});
      if (!of_master && !of_slave) out.own.push_back(text);
    }
  }
  return out;
}

}  // namespace

proto::LabConfig configure(const std::vector<std::string>& settings,
                           const std::filesystem::path& deploy_folder, const std::filesystem::path& from) {
  const FileSearch search = files_of(deploy_folder);
  proto::LabConfig config;
  const auto apply = [&](const std::string& setting) {
    set_lab_field(config, placed_setting(setting, search, from));
  };
  const Sorted all = sorted(settings);
  std::ranges::for_each(all.own, apply);
  const proto::LinkProfile profile = load_link_profile(search, config.profile());
  take_profile(*config.mutable_slave()->mutable_link(), profile);
  take_profile(*config.mutable_master()->mutable_link(), profile);
  config.mutable_master()->mutable_safety()->set_engage_at_start(true);
  Origins of_master, of_slave;
  of_master.add(config.master(), "laboratory");
  of_slave.add(config.slave(), "laboratory");
  assemble({[&config]() -> proto::MasterConfig& { return *config.mutable_master(); }, apply, true},
           all.master, search, {nullptr, &of_master, nullptr});
  Target<proto::SlaveConfig> slave{[&config]() -> proto::SlaveConfig& { return *config.mutable_slave(); },
                                   apply, true};
  if (mjcf_robots != nullptr) slave.read_mjcf = mjcf_robots->describe;
  assemble(slave, all.slave, search, {nullptr, &of_slave, nullptr});
  validate(config);
  std::vector<std::string> ineffective = ineffective_settings(config.master(), of_master);
  std::ranges::move(ineffective_settings(config.slave(), of_slave), std::back_inserter(ineffective));
  if (!ineffective.empty()) throw ConfigError(ineffective.front());
  if (!config.slave().robot().mjcf().empty())
    mjcf_robots->check(*config.mutable_slave(), of_slave.set_by_person("robot.servo_hz"));
  return config;
}

}  // namespace longreach
