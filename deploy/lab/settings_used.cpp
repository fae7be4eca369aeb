#include "deploy/lab/settings_used.hpp"

#include <algorithm>
#include <sstream>

#include "common/config/config.hpp"

namespace longreach {
namespace {

// Settings that only the programs use: addresses, real adapters, priorities, real operators. The laboratory
// engages by itself.
constexpr std::string_view kOfPrograms =
    " -rpc -device_adapter -robot_adapter -link.slave -link.listen -link.slave_rpc -link.impairment.rpc_delay_s "
    "-loop.priority "
    "-loop.lock_memory -operator.kind -operator.dead_zone -operator.reach_m -operator.reach_rad "
    "-safety.engage_at_start -operator.speed_m_per_s -operator.speed_rad_per_s -operator.pad "
    "-operator.rumble -scene.name "
    "-scene.basis -robot.name -robot.basis";

/// Returns the path without the names and indices of elements, which no experiment distinguishes.
std::string without_elements(const std::string& path) {
  std::string out;
  const google::protobuf::Descriptor* type = proto::LabConfig::descriptor();
  std::istringstream words(path);
  for (std::string word; std::getline(words, word, '.');) {
    const auto* field = type == nullptr ? nullptr : type->FindFieldByName(word);
    if (field == nullptr) continue;
    out += (out.empty() ? "" : ".") + word;
    type = field->message_type();
  }
  return out;
}

/// The field that represents a setting that selects many fields.
std::string judged_by(std::string field) {
  if (field == "profile") return "master.link.impairment.delay_s";
  if (field.ends_with(".accuracy")) return field.substr(0, field.find('.')) + ".loop.rate_hz";
  if (field.ends_with("_file")) field.resize(field.size() - std::string_view("_file").size());
  return field;
}

bool holds(std::string_view group, std::string_view field) {
  return field.starts_with(group) && (field.size() == group.size() || field[group.size()] == '.');
}

// Only experiments that name it run with a robot of MuJoCo: the others set up scenes that MuJoCo does not get.
bool is_mjcf(const std::string& path) { return path == "robot.mjcf" || path == "slave.robot.mjcf"; }

bool runs_mjcf(const Experiment& experiment) {
  std::istringstream words{std::string(experiment.uses)};
  for (std::string word; words >> word;)
    if (word == "robot.mjcf") return true;
  return false;
}

bool uses_field(const Experiment& experiment, const std::string& field) {
  const std::string_view of_side = std::string_view(field).substr(field.find('.') + 1);
  std::istringstream words(std::string(experiment.uses) + std::string(kOfPrograms));
  std::size_t longest = 0;
  bool used = false;
  for (std::string word; words >> word;) {
    const bool left_out = word.front() == '-';
    const std::string_view group = std::string_view(word).substr(left_out ? 1 : 0);
    const std::size_t depth = 1 + static_cast<std::size_t>(std::ranges::count(group, '.')) +
                              (holds(group, field) ? 0 : 1);  // counted from the LabConfig
    if ((!holds(group, field) && !holds(group, of_side)) || depth < longest) continue;
    longest = depth;
    used = !left_out;
  }
  return used;
}

}  // namespace

bool uses_setting(const Experiment& experiment, const std::string& path) {
  if (is_mjcf(path)) return runs_mjcf(experiment);
  return std::ranges::any_of(lab_fields(path), [&experiment](const std::string& field) {
    return uses_field(experiment, without_elements(judged_by(field)));
  });
}

std::string unused_sentence(const Experiment& experiment, const std::string& path) {
  const std::string name(experiment.name);
  if (is_mjcf(path)) {
    std::string others;
    for (const Experiment& other : experiments())
      if (runs_mjcf(other)) others += (others.empty() ? "" : ", ") + std::string(other.name);
    return name + " does not run with a robot of MuJoCo (" + path +
           "), because it sets up scenes of longreach itself; use one of these experiments: " + others;
  }
  if (experiment.uses.empty()) return name + " does not use " + path + " or any other setting";
  return name + " does not use " + path + "; it uses these settings: " + std::string(experiment.uses) +
         " (-NAME: except NAME)";
}

void refuse_unused(const Experiment& experiment, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::string path = setting.substr(0, setting.find('='));
    if (!uses_setting(experiment, path)) throw ConfigError(unused_sentence(experiment, path));
  }
}

}  // namespace longreach
