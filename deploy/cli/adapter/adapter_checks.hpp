#pragma once
// Checks an adapter against the rules of common/link/adapter_datagram.hpp. Each rule yields one finding; a
// violated rule also yields a remedy.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// Checks a device adapter. `force_n` is the maximum commanded force, > 0. If `device_file` is not empty, the
/// reported positions are compared with the workspace of that device. Throws UsageError.
Section check_device_adapter(const std::string& address, double force_n, const std::string& device_file);
/// Checks a robot adapter. `move_rad` is the maximum motion of the first joint, in rad (m for a prismatic
/// joint); 0 leaves the robot in place.
Section check_robot_adapter(const std::string& address, double move_rad);

}  // namespace longreach
