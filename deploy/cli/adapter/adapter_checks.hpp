#pragma once
// Does an adapter keep the rules of common/link/adapter_datagram.hpp? A finding a rule, with what to do.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// `force_n` > 0: the largest that it is asked for.
Section check_device_adapter(const std::string& address, double force_n);
/// `move_rad`: how far the first joint may move, m of a prismatic one; 0: not at all.
Section check_robot_adapter(const std::string& address, double move_rad);

}  // namespace longreach
