#pragma once
// Writes a robot as URDF: one link and one joint per Denavit-Hartenberg row, and a fixed joint to the link
// "tool".

#include <string>

#include "schema/config_slave.hpp"

namespace longreach {

/// Returns the text of the file. Reading it back gives the same forward kinematics, except for rounding.
std::string urdf_text(const RobotConfig& robot);

}  // namespace longreach
