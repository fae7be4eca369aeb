#pragma once
// A picture of an arm where it starts, as SVG: from ahead and from the side, as in a drawing.

#include <string>

#include "slave/config/robot_config.hpp"

namespace longreach {

std::string robot_picture(const RobotConfig& robot);

}  // namespace longreach
