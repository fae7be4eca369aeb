#pragma once
// Rates of the records that are stored less often than every tick, and capacities of the record buffers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace longreach {

constexpr double kViewHz = 100.0;
constexpr double kLinkHz = 20.0;

/// Returns the number of ticks between records that are stored `hz` times per second.
inline std::uint64_t ticks_between(double rate_hz, double hz) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(rate_hz / hz)));
}

/// Returns a capacity for 4 s, the maximum delay of the recorder thread. The capacity is always larger than
/// the number of records in one tick.
inline std::size_t record_capacity(double rate_hz) {
  return static_cast<std::size_t>(std::clamp(4.0 * 1.5 * rate_hz, 4096.0, 65536.0));
}

}  // namespace longreach
