#pragma once
// State of the hand at keyboard, gamepad or SpaceMouse.

#include "common/core/time.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct HandLevel {
  Vector3 target_m = Vector3::Zero();    // target of the hand, from handle home, M
  Vector3 target_rad = Vector3::Zero();  // likewise, rotation vector
  bool clutch = false;
  bool present = true;  // false: keyboard or pad is no longer available
  Time said{};          // when the hand was polled
};

}  // namespace longreach
