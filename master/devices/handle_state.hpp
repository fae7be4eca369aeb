#pragma once
// State of a pair of haptic devices in a tick.

#include "common/spatial/spatial.hpp"

namespace longreach {

/// True while pressed.
struct Buttons {
  bool mode = false;        // rate or position
  bool scale_up = false;    // coarser
  bool scale_down = false;  // finer
  bool clutch = false;      // the handle moves without the robot
};

struct HandleState {
  Vector3 p_MH = Vector3::Zero();  // position of the handle from home, m, in M
  Vector3 velocity_m_per_s = Vector3::Zero();
  Quaternion q_MH = Quaternion::Identity();  // orientation of the handle
  Vector3 angular_rad_per_s = Vector3::Zero();
  Buttons buttons{};
  bool held = true;  // a hand is on the handles; devices without a sensor report true
  bool ok = true;    // false: device fault; the other fields hold the last good values
};

}  // namespace longreach
