#pragma once
// Limits that follow from those of the commands.

#include <algorithm>

#include "schema/config_slave.hpp"

namespace longreach {

/// Maximum stiffness of a rotational stop against which the moment guard is effective, N m/rad.
constexpr double kGuardStiffness_nm_per_rad = 400.0;

/// Share of the force guard and of the moment guard that the inertia of a load in the gripper may use.
constexpr double kLoadGuardShare = 0.75;

/// Returns the limit to which a hold reduces the contact force, N.
inline double hold_limit_n(const CommandConfig& c) {
  return c.hold_force_n > 0.0 ? std::min(c.hold_force_n, c.force_guard_n) : 0.5 * c.force_guard_n;
}

/// Returns the limit to which a hold reduces the contact moment, N m.
inline double hold_limit_nm(const CommandConfig& c) { return 0.5 * c.moment_guard_nm; }

}  // namespace longreach
