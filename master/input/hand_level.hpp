#pragma once
// State of the operator's hand as given by keyboard, gamepad or SpaceMouse.

#include "common/core/time.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct HandLevel {
  Vector3 target_m = Vector3::Zero();    // target position of the hand, relative to the handle's home, M
  Vector3 target_rad = Vector3::Zero();  // target rotation vector, relative to the handle's home, M
  bool clutch = false;
  bool present = true;  // false: keyboard or pad is not available
  Time said{};          // time of the poll
};

}  // namespace longreach
