#pragma once
// Can the force guard hold what it promises with this robot, its sensor and its loop? A first touch at 50
// mm/s (or at the tool's speed limit, if that is lower) on 5 N/mm (or on the stiffest surface that the guard
// reckons with) may come to 1.35 times the guard (slave/config/guard_config.hpp).

#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Why not, as the rest of a sentence that begins with command.force_guard_n; empty if it can, or if the
/// scene has nothing to touch.
std::string unguarded(const proto::SlaveConfig& config);

/// Likewise of sensing.force_range_n and sensing.moment_range_nm: what the sensor cannot measure is not
/// guarded. Of a moment empty where nothing turns the tool.
std::string unmeasured_force(const proto::SlaveConfig& config);
std::string unmeasured_moment(const proto::SlaveConfig& config);

}  // namespace longreach
