#include "slave/ceiling.hpp"

#include <limits>

namespace longreach {
namespace {

// The least that a gap timer by the master's send rate can be: no longer for any master.
constexpr double kLeastByRate_s = 0.1;

struct Limit {
  std::string_view path;
  double start, after;  // after > start: looser
};

Limit gap(const SlaveSafetyConfig& start, const SlaveSafetyConfig& after) {
  constexpr std::string_view kPath = "safety.gap_s";
  if (start.gap_s > 0.0)
    return {kPath, start.gap_s, after.gap_s > 0.0 ? after.gap_s : std::numeric_limits<double>::infinity()};
  return {kPath, kLeastByRate_s, after.gap_s};
}

}  // namespace

std::optional<std::string_view> loosened(const SlaveConfig& start, const SlaveConfig& after) {
  const CommandConfig &c = start.command, &d = after.command;
  const SlaveSafetyConfig &s = start.safety, &t = after.safety;
  for (const Limit& limit :
       {Limit{"command.speed_max_m_per_s", c.speed_max_m_per_s, d.speed_max_m_per_s},
        Limit{"command.acceleration_max_m_per_s2", c.acceleration_max_m_per_s2, d.acceleration_max_m_per_s2},
        Limit{"command.speed_max_rad_per_s", c.speed_max_rad_per_s, d.speed_max_rad_per_s},
        Limit{"command.acceleration_max_rad_per_s2", c.acceleration_max_rad_per_s2,
              d.acceleration_max_rad_per_s2},
        Limit{"command.force_guard_n", c.force_guard_n, d.force_guard_n},
        Limit{"command.hold_force_n", hold_limit_n(c), hold_limit_n(d)},
        Limit{"command.workspace_m", c.workspace_m, d.workspace_m},
        // The guard brakes the earlier, the stiffer the surface that it reckons with.
        Limit{"command.guard_stiffness_n_per_m", -c.guard_stiffness_n_per_m, -d.guard_stiffness_n_per_m},
        // It begins to when a touch is noticed.
        Limit{"sensing.touch_n", start.sensing.touch_n, after.sensing.touch_n},
        Limit{"sensing.filter_s", start.sensing.filter_s, after.sensing.filter_s}, gap(s, t),
        Limit{"safety.age_max_s", s.age_max_s, t.age_max_s},
        Limit{"safety.resume_s", s.resume_s, t.resume_s}}) {
    if (limit.after > limit.start) return limit.path;
  }
  return std::nullopt;
}

}  // namespace longreach
