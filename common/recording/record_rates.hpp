#pragma once
// How often a tape keeps what is not needed of every tick, and how much it holds.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace longreach {

constexpr double kViewHz = 100.0;
constexpr double kLinkHz = 20.0;

/// Every how many ticks something is due `hz` times a second.
inline std::uint64_t ticks_between(double rate_hz, double hz) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(rate_hz / hz)));
}

/// Records of 4 s, which the recorder's thread may be held up for; more than what one tick can bring.
inline std::size_t record_capacity(double rate_hz) {
  return static_cast<std::size_t>(std::clamp(4.0 * 1.5 * rate_hz, 4096.0, 65536.0));
}

}  // namespace longreach
