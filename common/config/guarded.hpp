#pragma once
// Checks whether the force guard can limit the force with the configured robot, sensor and loop rate. At the
// first touch, the force must stay below 1.35 times the guard's limit. The check assumes a speed of 50 mm/s
// (or the speed limit of the tool, if lower) and a stiffness of 5 N/mm (or the maximum stiffness that the
// guard assumes, if lower); see slave/config/guard_config.hpp. What the sensor may hide of the force must also be
// at most 0.35 of the limit: half of its resolution, its drift in 10 s (2 standard deviations), and its bias,
// unless zeroing removes it, which is possible up to 0.6 of the limit (0.5 with sensing.zero_s). A longer contact
// may hide more drift.

#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Returns an empty string if the guard can limit the force or the robot has no force sensor. Otherwise returns
/// the reason, as the continuation of a sentence that starts with command.force_guard_n.
std::string unguarded(const proto::SlaveConfig& config);

/// Checks command.moment_guard_nm in the same way: what bias, drift and resolution of the sensor may hide must be
/// at most 0.35 of the limit, and the limit must be above sensing.touch_nm.
std::string unguarded_moment(const proto::SlaveConfig& config);

/// Checks command.guard_stiffness_n_per_m: a guard that assumes surfaces softer than 1 N/mm brakes too late on
/// those of everyday life.
std::string too_soft(const proto::SlaveConfig& config);

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
