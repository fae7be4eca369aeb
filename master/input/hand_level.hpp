#pragma once
// What a person holds at keyboard, gamepad or SpaceMouse, as a level.

#include "common/core/time.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct HandLevel {
  Vector3 target_m = Vector3::Zero();    // where the hand wants to be, from handle home, M
  Vector3 target_rad = Vector3::Zero();  // likewise, rotation vector
  bool clutch = false;
  bool present = true;  // false: keyboard or pad is not there any more
  Time said{};          // when the hand was asked for it
};

}  // namespace longreach
