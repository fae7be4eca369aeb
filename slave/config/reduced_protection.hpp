#pragma once
// Protections that the configuration of the slave makes ineffective.

#include <algorithm>

#include "common/link/protection.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

/// Returns the bits of Protection.
inline std::uint32_t reduced_protection(const SlaveConfig& c) {
  const SensingConfig& s = c.sensing;
  const double dt = 1.0 / c.loop.rate_hz;
  const bool jerks = std::ranges::any_of(c.robot.joint, [&](const JointConfig& j) {
    return j.kind != JointKind::kFixed && 2.0 * j.acceleration_max_rad_per_s2 <= j.jerk_max_rad_per_s3 * dt;
  });
  std::uint32_t reduced = 0;
  reduced = with(reduced, Protection::kForceGuard, !s.force);
  const bool real = !c.robot_adapter.address.empty();
  reduced = with(reduced, Protection::kMomentGuard, !measures_moment(s));
  const bool coarse_force = s.force_noise_n <= 0.5 * s.force_resolution_n;
  const bool coarse_moment = measures_moment(s) && s.moment_noise_nm <= 0.5 * s.moment_resolution_nm;
  reduced = with(reduced, Protection::kFrozenSensor, s.force && (coarse_force || coarse_moment));
  reduced = with(reduced, Protection::kSaturatedSensor, s.force && !(s.force_range_n > 0.0) && real);
  reduced = with(reduced, Protection::kJointJerk, jerks);
  return with(reduced, Protection::kDelayRise, c.safety.delay_rise_max_s > kDelayRiseNoticed_s);
}

}  // namespace longreach
