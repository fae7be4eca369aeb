#pragma once
// What a haptic device tells and takes, once a tick.

#include "common/spatial/spatial.hpp"

namespace longreach {

struct HandleState {
  Vector3 p_MH = Vector3::Zero();  // position of the handle from home, m, in M
  Vector3 velocity_m_per_s = Vector3::Zero();
  Quaternion q_MH = Quaternion::Identity();  // orientation of the handle
  Vector3 angular_rad_per_s = Vector3::Zero();
  bool ok = true;  // false: device fault; the other fields hold the last good values
};

}  // namespace longreach
