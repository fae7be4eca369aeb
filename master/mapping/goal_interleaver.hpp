#pragma once
// Whose turn it is: each datagram carries the goal of one device (Liu et al. 2019). Both move: translation
// is sent. A device has moved when its goal has left, by more than two encoder counts of a desktop device
// scaled like the motion, what was sent of it last; so noise does not take the other's turns. The device that
// has to wait takes every eighth turn, so that the loss of its last goal loses nothing.

#include <cstdint>

#include "common/link/motion_command.hpp"
#include "master/mapping/mapping.hpp"

namespace longreach {

class GoalInterleaver {
 public:
  /// The kind that the datagram of this period carries; it counts as sent.
  GoalKind next(const Goal& goal, double scale);

 private:
  Goal sent_{};                // of each device, when it was sent last
  std::uint32_t waiting_ = 0;  // turns since the other device had one
};

}  // namespace longreach
