#pragma once
// How fast the tool may touch a surface that is not known yet (guard_config.hpp): the stiffest surface that the guard
// assumes must not be pressed with more than 1.35 times the guard's limit.

#include <algorithm>
#include <numbers>
#include <optional>

#include "slave/config/guard_config.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

/// Returns the first touch of the stiffest surface, without its speed; none if the robot measures no force.
inline std::optional<FirstTouch> first_touch(const SlaveConfig& c) {
  if (!c.sensing.force) return std::nullopt;
  const auto first_order_s = [](double hz) { return hz > 0.0 ? 0.5 / (std::numbers::pi * hz) : 0.0; };
  double jerk_s = 0.0;  // lag of the setpoint due to the jerk limit
  for (const JointConfig& j : c.robot.joint)
    jerk_s = std::max(jerk_s, j.acceleration_max_rad_per_s2 / j.jerk_max_rad_per_s3);
  return FirstTouch{.stiffness_n_per_m = c.command.guard_stiffness_n_per_m,
                    .guard_stiffness_n_per_m = c.command.guard_stiffness_n_per_m,
                    .deceleration_m_per_s2 = c.command.braking_max_m_per_s2,
                    .lag_s = 1.0 / c.loop.rate_hz + jerk_s + first_order_s(c.sensing.bandwidth_hz),
                    .servo_s = first_order_s(c.robot.servo_hz),
                    .touch_n = configured_touch_n(c.sensing),
                    .filter_s = c.sensing.filter_s};
}

}  // namespace longreach
