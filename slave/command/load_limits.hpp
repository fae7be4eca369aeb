#pragma once
// Acceleration limits while the gripper holds a load, so that its inertia loads the tool with at most a share s of the
// force guard G and of the moment guard M:
//   a <= s G/m,  α <= s M/(m r²),  s = 0.75
// where m is an upper bound on the mass, robot.load_max_kg until the load is identified (load_identifier.hpp), and r the
// maximum radius of gyration of a load about the tool; its moments of inertia are not identified. For example, G = 20 N,
// M = 5 N m and m = 30 kg give 0.5 m/s² and 0.125 rad/s². A load of any mass can be moved: the limits are not reduced
// below kLoadAcceleration_min. An empty gripper sets no limit.
//
// Pure; allocates nothing.

#include <algorithm>

#include "slave/config/command_config.hpp"

namespace longreach {

constexpr double kLoadGyration_m = 1.0;         // r
constexpr double kLoadAcceleration_min = 0.01;  // m/s² or rad/s²

/// Returns the limits in force with a load of at most `load_kg`; 0: the gripper is empty.
inline CommandConfig with_load(CommandConfig c, double load_kg) {
  if (load_kg <= 0.0) return c;
  // A bound that is not a number counts as the greatest mass.
  const auto lower = [](double configured, double limit) {
    return std::min(configured, limit > kLoadAcceleration_min ? limit : kLoadAcceleration_min);
  };
  c.acceleration_max_m_per_s2 =
      lower(c.acceleration_max_m_per_s2, kLoadGuardShare * c.force_guard_n / load_kg);
  c.acceleration_max_rad_per_s2 =
      lower(c.acceleration_max_rad_per_s2,
            kLoadGuardShare * c.moment_guard_nm / (load_kg * kLoadGyration_m * kLoadGyration_m));
  return c;
}

}  // namespace longreach
