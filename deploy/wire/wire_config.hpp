#pragma once
// What a wire does to packets, however they come to it.

#include <cstdint>

namespace longreach {

struct WireConfig {
  double delay_s = 0.0;  // of each packet, each way
  double loss = 0.0;     // fraction, independent from packet to packet
  std::uint64_t seed = 1;
};

}  // namespace longreach
