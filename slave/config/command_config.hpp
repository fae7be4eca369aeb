#pragma once
// Limits of the commands to the robot. proto/config.proto documents the meaning, unit and range of these
// fields under the same names.

#include <algorithm>
#include <cstdint>

namespace longreach {

struct CommandConfig {
  double speed_max_m_per_s = 0.25;
  double acceleration_max_m_per_s2 = 1.25;
  double speed_max_rad_per_s = 0.3;
  double acceleration_max_rad_per_s2 = 2.0;
  double force_guard_n = 20.0;
  double guard_stiffness_n_per_m = 2e4;
  double workspace_m = 3.0;
  double tolerance_m = 1e-10;
  std::uint32_t iterations_max = 20;
  double hold_force_n = 0.0;
  double moment_guard_nm = 5.0;
  double give_way_m = 0.2;
  double braking_max_m_per_s2 = 10.0;
};

/// Maximum stiffness of a rotational stop against which the moment guard is effective, N m/rad.
constexpr double kGuardStiffness_nm_per_rad = 400.0;

/// Returns the limit to which a hold reduces the contact force, N.
inline double hold_limit_n(const CommandConfig& c) {
  return c.hold_force_n > 0.0 ? std::min(c.hold_force_n, c.force_guard_n) : 0.5 * c.force_guard_n;
}

/// Returns the limit to which a hold reduces the contact moment, N m.
inline double hold_limit_nm(const CommandConfig& c) { return 0.5 * c.moment_guard_nm; }

}  // namespace longreach
