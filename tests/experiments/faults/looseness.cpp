#include "tests/experiments/faults/looseness.hpp"

#include <vector>

namespace longreach {
namespace {

/// What weakens a guard, by a list of its own: name, and how loose it is.
struct Looseness {
  const char* name;
  double slack;
};

std::vector<Looseness> looseness(const SlaveConfig& c) {
  const SlaveSafetyConfig& s = c.safety;
  return {{"command.speed_max_m_per_s", c.command.speed_max_m_per_s},
          {"command.acceleration_max_m_per_s2", c.command.acceleration_max_m_per_s2},
          {"command.speed_max_rad_per_s", c.command.speed_max_rad_per_s},
          {"command.acceleration_max_rad_per_s2", c.command.acceleration_max_rad_per_s2},
          {"command.force_guard_n", c.command.force_guard_n},
          {"command.hold_force_n", hold_limit_n(c.command)},
          {"command.moment_guard_nm", c.command.moment_guard_nm},
          {"command.give_way_m", c.command.give_way_m},
          {"command.workspace_m", c.command.workspace_m},
          {"sensing.touch_n", c.sensing.touch_n},
          {"sensing.filter_s", c.sensing.filter_s},
          {"sensing.zero_s", c.sensing.zero_s},
          {"safety.gap_s", gap_s(s, 1000.0)},
          {"safety.age_max_s", s.age_max_s},
          {"safety.resume_s", s.resume_s}};
}
std::vector<Looseness> looseness(const MasterConfig& c) {
  return {{"rendering.force_max_n", c.rendering.force_max_n},
          {"rendering.moment_max_nm", c.rendering.moment_max_nm},
          {"rendering.slew_n_per_s", c.rendering.slew_n_per_s},
          {"rendering.slew_nm_per_s", c.rendering.slew_nm_per_s},
          {"rendering.stiffness_max_n_per_m", c.rendering.stiffness_max_n_per_m},
          {"safety.silence_s", c.safety.silence_s},
          {"safety.resume_s", c.safety.resume_s},
          {"safety.presence_s", c.safety.presence_s}};
}
template <class Config>
std::string first_looser(const Config& start, const Config& now) {
  const std::vector<Looseness> before = looseness(start), after = looseness(now);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (after[i].slack > before[i].slack) return std::string(before[i].name) + " is looser than at the start";
  return {};
}

}  // namespace

std::string looser(const SlaveConfig& start, const SlaveConfig& now) { return first_looser(start, now); }
std::string looser(const MasterConfig& start, const MasterConfig& now) { return first_looser(start, now); }

}  // namespace longreach
