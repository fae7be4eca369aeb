// Settings that another setting makes ineffective: accepted, shown, and without any effect.

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "common/config/effective.hpp"
#include "common/config/field_text.hpp"

namespace longreach {
namespace {

/// Fields (or groups) that have no effect under a condition. An element of a path that is "*" stands for any index.
template <class Side>
struct Rule {
  std::string_view fields;  // separated by spaces
  bool (*ineffective)(const Side&);
  std::string_view because;
};

bool is_real(const proto::SlaveConfig& c) { return !c.robot_adapter().address().empty(); }
bool is_real(const proto::MasterConfig& c) { return !c.device_adapter().address().empty(); }

bool is_mujoco(const proto::SlaveConfig& c) { return !c.robot().mjcf().empty(); }

bool any_spring(const proto::SlaveConfig& c) {
  return std::ranges::any_of(c.robot().joint(),
                             [](const proto::Joint& joint) { return joint.stiffness_nm_per_rad() > 0.0; });
}

constexpr std::array kSlaveChoices{
    Rule<proto::SlaveConfig>{"scene scene_file", is_real, "robot_adapter.address is set: the robot is real"},
    Rule<proto::SlaveConfig>{
        "robot.start_rad robot.joint.*.start_rad robot.joint.*.stiffness_nm_per_rad "
        "robot.joint.*.damping_nm_s_per_rad robot.joint.*.friction_nm robot.joint.*.inertia_kg_m2 "
        "sensing.force_bias_n sensing.moment_bias_nm",
        is_real, "robot_adapter.address is set: it describes the simulated robot"},
    Rule<proto::SlaveConfig>{"scene scene_file robot.joint.*.stiffness_nm_per_rad "
                             "robot.joint.*.damping_nm_s_per_rad robot.joint.*.friction_nm "
                             "robot.joint.*.inertia_kg_m2",
                             is_mujoco,
                             "robot.mjcf is set: the MJCF file describes the robot and its surroundings"},
    Rule<proto::SlaveConfig>{
        "robot.joint.*.damping_nm_s_per_rad robot.joint.*.friction_nm robot.joint.*.inertia_kg_m2",
        [](const proto::SlaveConfig& c) { return !is_real(c) && !is_mujoco(c) && !any_spring(c); },
        "stiffness_nm_per_rad of every joint is 0: the joints are rigid"},
    Rule<proto::SlaveConfig>{"scene.needs", [](const proto::SlaveConfig& c) { return !is_real(c); },
                             "the sensing settings decide what is measured and guarded"},
    Rule<proto::SlaveConfig>{
        "estimator.exponent",
        [](const proto::SlaveConfig& c) { return c.estimator().kind() != proto::Estimator::FIXED_EXPONENT; },
        "estimator.kind is not FIXED_EXPONENT: the exponent is identified"},
    Rule<proto::SlaveConfig>{"playout.fixed_delay_s",
                             [](const proto::SlaveConfig& c) { return c.playout().adaptive(); },
                             "playout.adaptive is true"},
    Rule<proto::SlaveConfig>{"playout.quantile playout.delay_max_s",
                             [](const proto::SlaveConfig& c) { return !c.playout().adaptive(); },
                             "playout.adaptive is false"},
    Rule<proto::SlaveConfig>{
        "estimator sensing.touch_n sensing.release_n command.force_guard_n command.guard_stiffness_n_per_m "
        "command.hold_force_n command.give_way_m",
        [](const proto::SlaveConfig& c) { return !c.sensing().force(); },
        "sensing.force is false: the robot has no force sensor"},
    Rule<proto::SlaveConfig>{"sensing.touch_nm sensing.release_nm command.moment_guard_nm",
                             [](const proto::SlaveConfig& c) { return !c.sensing().moment(); },
                             "sensing.moment is false: the robot does not measure the moment"},
};

constexpr std::array kMasterChoices{
    Rule<proto::MasterConfig>{"device.spherical",
                              [](const proto::MasterConfig& c) { return !c.device().turns(); },
                              "device.turns is false: the handle does not turn"},
    Rule<proto::MasterConfig>{
        "device.behaviour.guide_n_per_m device.behaviour.guide_nm_per_rad device.behaviour.free_m "
        "device.behaviour.free_rad",
        [](const proto::MasterConfig& c) {
          return c.device().behaviour().motion() != proto::Behaviour::DECOUPLED;
        },
        "device.behaviour.motion is not DECOUPLED"},
    Rule<proto::MasterConfig>{
        "safety.presence_s",
        [](const proto::MasterConfig& c) { return c.safety().presence() != proto::MasterSafety::HOLD; },
        "safety.presence is not HOLD"},
    Rule<proto::MasterConfig>{
        "operator.pad operator.rumble",
        [](const proto::MasterConfig& c) { return c.operator_().kind() != proto::Operator::GAMEPAD; },
        "operator.kind is not GAMEPAD"},
    Rule<proto::MasterConfig>{
        "operator.rate_distance_m operator.approach_speed_m_per_s operator.press_n "
        "operator.probe_n operator.probe_hz operator.probe_cycles operator.direction "
        "operator.reaction_s",
        [](const proto::MasterConfig& c) { return c.operator_().kind() != proto::Operator::SCRIPT; },
        "operator.kind is not SCRIPT"},
    Rule<proto::MasterConfig>{"hand", [](const proto::MasterConfig& c) { return is_real(c); },
                              "device_adapter.address is set: the hand is real"},
};

bool matches(std::string_view pattern, std::string_view path) {
  while (!pattern.empty()) {
    const std::string_view wanted = pattern.substr(0, pattern.find('.'));
    const std::string_view word = path.substr(0, path.find('.'));
    if (word.empty() || (wanted != "*" && wanted != word)) return false;
    pattern.remove_prefix(std::min(wanted.size() + 1, pattern.size()));
    path.remove_prefix(std::min(word.size() + 1, path.size()));
  }
  return true;
}

bool concerns(std::string_view fields, std::string_view path) {
  while (!fields.empty()) {
    const std::string_view pattern = fields.substr(0, fields.find(' '));
    if (matches(pattern, path)) return true;
    fields.remove_prefix(std::min(pattern.size() + 1, fields.size()));
  }
  return false;
}

// A robot.start_rad that sets six joints is one setting, not seven.
bool is_spread(const Origins& origins, const std::string& path) {
  return path.starts_with("robot.joint.") && path.ends_with(".start_rad") &&
         origins.set_by_person("robot.start_rad");
}

// A configuration file that was written by `longreach get` sets every field.
bool is_default(const google::protobuf::Message& config, const std::string& path) {
  const PathLookup found = find_path(config, path);
  if (!found.error.empty()) return false;
  const google::protobuf::Message& at = holder(config, found.path);
  const std::unique_ptr<google::protobuf::Message> defaults(at.New());
  return value_text(at, found.path.back()) == value_text(*defaults, found.path.back());
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

template <class Side>
std::vector<std::string> sentences(const Side& config, const Origins& origins,
                                   std::span<const Rule<Side>> rules) {
  std::vector<std::string> sentences;
  const std::vector<std::string> paths = origins.set_by_person();
  for (const Rule<Side>& rule : rules) {
    if (!rule.ineffective(config)) continue;
    std::vector<std::string> named;
    for (const std::string& path : paths) {
      if (!concerns(rule.fields, path) || is_spread(origins, path)) continue;
      if (origins.of(path) == kFromCommandLine || !is_default(config, path)) named.push_back(path);
    }
    if (!named.empty())
      sentences.push_back(listed(named) + (named.size() == 1 ? " has" : " have") + " no effect, because " +
                          std::string(rule.because));
  }
  return sentences;
}

}  // namespace

std::vector<std::string> ineffective_settings(const proto::SlaveConfig& config, const Origins& origins) {
  return sentences<proto::SlaveConfig>(config, origins, kSlaveChoices);
}

std::vector<std::string> ineffective_settings(const proto::MasterConfig& config, const Origins& origins) {
  return sentences<proto::MasterConfig>(config, origins, kMasterChoices);
}

}  // namespace longreach
