#pragma once
// Delay and loss of a link, independent of how the packets are intercepted.

#include <cstdint>

namespace longreach {

struct WireConfig {
  double delay_s = 0.0;  // one-way delay of every packet, in both directions
  double loss = 0.0;     // probability of losing a packet, independent of the others
  std::uint64_t seed = 1;
};

}  // namespace longreach
