#pragma once
// Selects the goal of a datagram: each datagram carries the goal of one device (Liu et al. 2019). If both
// move, translation is sent. A device has moved if its goal differs from its last sent one by more than two
// encoder counts of a desktop device, scaled like the motion; noise therefore does not use datagrams. The
// waiting device gets every eighth datagram, so that its last goal is repeated and may be lost.

#include <cstdint>

#include "common/link/motion_command.hpp"
#include "master/mapping/mapping.hpp"

namespace longreach {

class GoalInterleaver {
 public:
  /// Returns the kind of the goal in the datagram of this period, which counts as sent.
  GoalKind next(const Goal& goal, double scale);

 private:
  Goal sent_{};                // last sent goal of each device
  std::uint32_t waiting_ = 0;  // datagrams since the other device was sent
};

}  // namespace longreach
