#pragma once
// Reads robots from URDF files (1.0 to 1.2): converts the arm between two links to a Denavit-Hartenberg table. Only
// geometry, limits and names are read; meshes, inertias, sensors and all other content are ignored. W is the frame of the
// base link, and E the frame of the tip link. The joints have the same zero position as in the file.

#include <filesystem>
#include <string>
#include <vector>

#include "proto/config.pb.h"

namespace longreach {

inline constexpr const char* kUrdfExtension = ".urdf";

/// Returns whether `name`, a file name, has this extension, in upper or lower case.
bool is_urdf(const std::string& name);

/// Returns whether a text begins like XML, after a byte order mark and white space, also in UTF-16.
bool looks_like_xml(const std::string& text);

/// Converts a URDF to a robot with six joints. `wanted` contains base_link and tip_link, if they are set. The
/// result contains the base_link and tip_link that were found. Continuous joints, and revolute joints with wider
/// limits, are limited to two turns in each direction. Limits of acceleration and jerk that the file does not
/// contain are not set; deceleration limits the acceleration, too. Appends to `ignored`, if it is not null, one
/// sentence for each kind of content that concerns the motion of the arm and is not supported. Throws ConfigError
/// "NAME:LINE: ...".
proto::Robot read_urdf(const std::string& name, const std::string& text, const proto::Robot& wanted,
                       std::vector<std::string>* ignored = nullptr);

}  // namespace longreach
