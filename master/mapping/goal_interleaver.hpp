#pragma once
// Selects the goal of a datagram: each datagram carries the goal of one device (Liu et al. 2019). If both
// devices move, the translation is sent. A device has moved if its goal differs from the last one sent by
// more than two encoder counts of a desktop device, scaled like the motion, so that noise does not use up
// datagrams. Every eighth datagram carries the goal of the other device. The last goal of that device is thus
// repeated, and the loss of one datagram does no harm.

#include <cstdint>

#include "master/mapping/mapping.hpp"
#include "schema/state_link.hpp"

namespace longreach {

class GoalInterleaver {
 public:
  /// Returns the kind of goal that the datagram of this period carries, and records it as sent.
  GoalKind next(const Goal& goal, double scale);

 private:
  Goal sent_{};                // goal of each device when it was last sent
  std::uint32_t waiting_ = 0;  // number of datagrams since the last one with the goal of the other device
};

}  // namespace longreach
