#include "common/config/effective.hpp"

#include <algorithm>
#include <type_traits>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"

namespace longreach {
namespace {

Setting parsed(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw ConfigError("--set '" + text + "': write path=value, e.g. loop.rate_hz=2000");
  return {text.substr(0, equals), text};
}

}  // namespace

template <class Side>
Effective<Side> effective_config(const Asked& asked) {
  Effective<Side> out;
  const FileSearch installed = installed_files();
  const FileSearch search = asked.config.empty() ? installed : installed.beside(asked.config);
  if (!asked.config.empty()) {
    const std::filesystem::path path = std::filesystem::absolute(asked.config);
    load_text_file(asked.config, out.config);
    out.files.push_back({"config", path});
    out.origins.add(out.config, std::string(kFromConfigFile) + " " + path.string());
  }
  if (!asked.profile.empty()) {
    take_profile(*out.config.mutable_link(), load_link_profile(search, asked.profile, &out.files));
    out.origins.forget("link.impairment");
    out.origins.add(out.config, "link profile " + asked.profile);
  }
  std::vector<Setting> settings;
  for (const std::string& text : asked.settings) settings.push_back(parsed(text));
  const auto apply = [&out, &search](const std::string& text) {
    const Setting placed = parsed(placed_setting(text, search));
    set_field(out.config, placed.path, placed.text.substr(placed.path.size() + 1));
  };
  assemble({[&out]() -> Side& { return out.config; }, apply}, settings, search,
           {&out.files, &out.origins, &out.warnings});
  std::ranges::move(ineffective_settings(out.config, out.origins), std::back_inserter(out.warnings));
  return out;
}

template <class Side>
std::string check_text(const Effective<Side>& effective, const std::string& notes) {
  std::string text;
  for (const FileRead& file : effective.files) text += "# " + file.field + "=" + file.path.string() + "\n";
  text += notes;
  for (const std::string& warning : effective.warnings) text += "# warning: " + warning + "\n";
  return text + get_field_with_origins(effective.config, "", &effective.config, effective.origins);
}

template Effective<proto::MasterConfig> effective_config(const Asked&);
template Effective<proto::SlaveConfig> effective_config(const Asked&);
template std::string check_text(const Effective<proto::MasterConfig>&, const std::string&);
template std::string check_text(const Effective<proto::SlaveConfig>&, const std::string&);

}  // namespace longreach
