#pragma once
// Robots from URDF files: the arm between two links, as rows of a Denavit-Hartenberg table. Geometry, limits
// and names are read; meshes, inertias, sensors and what else such a file holds are not looked at.
// W is the frame of the base link, E that of the tip link; joints count from the file's own zero.

#include <filesystem>
#include <string>

#include "proto/config.pb.h"

namespace longreach {

inline constexpr const char* kUrdfExtension = ".urdf";

/// A file that ends so.
bool is_urdf(const std::string& name);

/// The robot of a URDF. `wanted`: base_link, tip_link and start_rad, where set, and the limits that a URDF
/// does not have. Result: a robot with six joints, base_link and tip_link as found; continuous joints, and
/// revolute ones with wider limits, may turn twice either way. Throws ConfigError "NAME:LINE: ...".
proto::Robot read_urdf(const std::string& name, const std::string& text, const proto::Robot& wanted);

}  // namespace longreach
