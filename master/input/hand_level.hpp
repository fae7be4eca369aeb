#pragma once
// State of the operator's hand as given by keyboard, gamepad or SpaceMouse, and the place at which such a hand begins.

#include <cstdint>

#include "common/core/time.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

/// Where the hand begins after a change: another hand had the handle, an engagement begins, or the hand was not
/// available. It begins where the handle is, so that a change causes no motion.
struct HandBegin {
  std::uint32_t change = 0;              // number of the change
  Vector3 target_m = Vector3::Zero();    // position of the handle, M
  Vector3 target_rad = Vector3::Zero();  // its rotation vector from home, M
};

struct HandLevel {
  Vector3 target_m = Vector3::Zero();    // target position of the hand, relative to the handle's home, M
  Vector3 target_rad = Vector3::Zero();  // target rotation vector, relative to the handle's home, M
  bool clutch = false;
  std::uint32_t change =
      0;                // number of the last change from which the hand began; an older one does not count
  bool present = true;  // false: keyboard or pad is not available
  Time said{};          // time of the poll
};

}  // namespace longreach
