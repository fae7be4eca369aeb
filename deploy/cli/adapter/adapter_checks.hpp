#pragma once
// Checks an adapter against the rules of common/link/adapter_datagram.hpp, with one finding and remedy per
// rule.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// `force_n` > 0: maximum commanded force.
Section check_device_adapter(const std::string& address, double force_n);
/// `move_rad`: maximum motion of the first joint, m for a prismatic one; 0: none.
Section check_robot_adapter(const std::string& address, double move_rad);

}  // namespace longreach
