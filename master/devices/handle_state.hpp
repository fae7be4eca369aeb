#pragma once
// State of a pair of haptic devices in one tick.

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Buttons of the handle; true while pressed.
struct Buttons {
  bool mode = false;        // switches between rate and position mode
  bool scale_up = false;    // coarser motion
  bool scale_down = false;  // finer motion
  bool clutch = false;      // the handle moves without the robot
};

struct HandleState {
  Vector3 p_MH = Vector3::Zero();  // position of the handle from home, m, in M
  Vector3 velocity_m_per_s = Vector3::Zero();
  Quaternion q_MH = Quaternion::Identity();  // orientation of the handle in M; home is the identity
  Vector3 angular_rad_per_s = Vector3::Zero();
  Buttons buttons{};
  bool held = true;  // a hand is on the handle; devices without a sensor report true
  bool ok = true;    // false: device fault; the other fields keep the last valid values
};

}  // namespace longreach
