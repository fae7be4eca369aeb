#pragma once
// Checks whether the force guard can limit the force with the configured robot, sensor and loop rate. At the
// first touch, the force must stay below 1.35 times the guard's limit. The check assumes a speed of 50 mm/s
// (or the speed limit of the tool, if lower) and a stiffness of 5 N/mm (or the maximum stiffness that the
// guard assumes, if lower); see slave/config/guard_config.hpp.

#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Returns an empty string if the guard can limit the force or the robot has no force sensor. Otherwise returns
/// the reason, as the continuation of a sentence that starts with command.force_guard_n.
std::string unguarded(const proto::SlaveConfig& config);

/// Returns the touch threshold that these checks assume, N: the configured threshold, or its upper bound if
/// it is derived from the sensor noise.
double guarded_touch_n(const proto::Sensing& sensing);
/// Returns a description of this threshold, with its value.
std::string touch_text(const proto::Sensing& sensing);

/// Check sensing.force_range_n and sensing.moment_range_nm in the same way, because the guards cannot limit
/// values beyond the range of the sensor. unmeasured_moment() returns an empty string if no moment
/// is measured.
std::string unmeasured_force(const proto::SlaveConfig& config);
std::string unmeasured_moment(const proto::SlaveConfig& config);

}  // namespace longreach
