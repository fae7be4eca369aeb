#pragma once
// An SVG picture of an arm in its start pose, seen from the side and from above.

#include <string>

#include "schema/config_slave.hpp"

namespace longreach {

std::string robot_picture(const RobotConfig& robot);

}  // namespace longreach
