#pragma once
// Kinds, groups of kinds and invariants that are left out of the swarm, because what they find is known and
// is being mended. Empty when all is well.

#include <algorithm>
#include <string_view>
#include <vector>

namespace longreach {

inline bool awaited(std::string_view name) {
  static const std::vector<std::string_view> kAwaited = {
      // I21, I6, L2: a robot that somebody has pressed into the wall is engaged there with the force it has.
      "robot-moved",
      // L3: a robot that has crept away does not come back to its goal.
      "robot-creeps",
      // I8: what is left of a braking way is set after the robot's own watchdog has stopped it, 2.02 mrad of
      // 2.
      "slave-frozen"};
  return std::ranges::find(kAwaited, name) != kAwaited.end();
}

}  // namespace longreach
