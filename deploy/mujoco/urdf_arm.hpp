#pragma once
// The arm of a URDF as MuJoCo simulates it. MuJoCo reads a URDF, but it cannot give it sensors, so the file is changed in
// memory in two steps:
//
//   URDF, changed by urdf_arm()  ->  MuJoCo  ->  MJCF as MuJoCo writes it, changed by with_sensors()  ->  MuJoCo
//
// The arm is what the slave reads from the same file (common/config/robot/urdf.hpp): six joints between the root and the
// tool link, their limits and their start. Other joints are fixed at zero. Links are not fused. Of the shapes, only those
// of <collision> are used, and of the meshes only STL and OBJ files that exist.

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "proto/config_slave.pb.h"

namespace longreach {

struct UrdfArm {
  std::string text;    // the URDF for MuJoCo
  proto::Robot robot;  // as the slave reads it; tip_link is the tool link
  std::vector<std::string>
      notes{};  // what is not simulated, one sentence for each kind, beginning with the file
};

/// Whether the root element of an XML file is that of a URDF. False if there is no such file or it is not XML.
bool holds_urdf(const std::string& file);

/// Reads a URDF. If `tool_link` is empty, the tool is the only end link behind six joints. Throws
/// std::invalid_argument "FILE:LINE: reason" or "FILE: reason".
UrdfArm urdf_arm(const std::string& file, const std::string& tool_link);

/// Returns the MJCF of the file that MuJoCo loaded last, which became `model`. Throws std::invalid_argument "FILE: reason".
std::string last_mjcf(const std::string& file, const mjModel& model);

/// Returns `mjcf`, which MuJoCo wrote for arm.text, with a site named `site` at the tool link, a force and a torque sensor
/// there, the limits and the start of the joints, and a time step of 0.5 ms if there is none. If the tool link is moved by a
/// joint, its shapes and its mass move to a body of its own, so that the sensors measure no torque of the joint. `exact` is
/// the model of arm.text: MuJoCo writes only six digits. Appends to `notes` if nothing can touch the tool.
std::string with_sensors(const std::string& mjcf, const mjModel& exact, const UrdfArm& arm,
                         const std::string& site, std::vector<std::string>& notes);

}  // namespace longreach
