#pragma once
// Reads robots from URDF files: converts the arm between two links to a Denavit-Hartenberg table. Only geometry,
// limits and names are read; meshes, inertias, sensors and all other content are ignored. W is the frame of the
// base link, and E the frame of the tip link. The joints have the same zero position as in the file.

#include <filesystem>
#include <string>

#include "proto/config.pb.h"

namespace longreach {

inline constexpr const char* kUrdfExtension = ".urdf";

/// Returns whether `name`, a file name, has this extension.
bool is_urdf(const std::string& name);

/// Converts a URDF to a robot with six joints. `wanted` contains base_link, tip_link and start_rad, if they
/// are set, and the limits that a URDF does not define. The result contains the base_link and tip_link that
/// were found. Continuous joints, and revolute joints with wider limits, are limited to two turns in each
/// direction. Throws ConfigError "NAME:LINE: ...".
proto::Robot read_urdf(const std::string& name, const std::string& text, const proto::Robot& wanted);

}  // namespace longreach
