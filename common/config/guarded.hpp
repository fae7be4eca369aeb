#pragma once
// Checks whether the force guard can keep its bound with this robot, sensor and loop: a first touch at 50
// mm/s (or at the speed limit of the tool, if that is lower) on 5 N/mm (or on the maximum stiffness that the
// guard assumes) must stay below 1.35 times the guard (slave/config/guard_config.hpp).

#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Returns why not, as the remainder of a sentence that begins with command.force_guard_n; empty if it can,
/// or if the scene has no surfaces.
std::string unguarded(const proto::SlaveConfig& config);

/// Returns the touch threshold that the checks of the guards use, N: as configured, or the upper bound of a
/// derived one.
double guarded_touch_n(const proto::Sensing& sensing);
/// Returns a description of it with its value.
std::string touch_text(const proto::Sensing& sensing);

/// The same for sensing.force_range_n and sensing.moment_range_nm: a force beyond the range of the sensor is
/// not guarded. Empty for a moment if nothing rotates the tool.
std::string unmeasured_force(const proto::SlaveConfig& config);
std::string unmeasured_moment(const proto::SlaveConfig& config);

}  // namespace longreach
