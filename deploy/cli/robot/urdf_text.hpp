#pragma once
// A robot as URDF: one link and one joint a row, and a fixed joint to the link "tool".

#include <string>

#include "slave/config/robot_config.hpp"

namespace longreach {

/// Read again, the file places the tool as `robot` does, to rounding.
std::string urdf_text(const RobotConfig& robot);

}  // namespace longreach
