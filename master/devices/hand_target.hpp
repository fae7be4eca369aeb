#pragma once
// Target of the simulated hand on the handles.

#include "common/spatial/spatial.hpp"
#include "schema/config_master.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Desired pose of the handle, and how firmly the hand grips it.
struct HandTarget {
  Vector3 position_m = Vector3::Zero();  // from home, in M
  Vector3 velocity_m_per_s = Vector3::Zero();
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector from home, in M
  Grip grip = Grip::kLight;
  Buttons buttons{};
};

}  // namespace longreach
