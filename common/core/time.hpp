#pragma once
// Instants and durations in 64-bit nanoseconds, which cover 292 years. Each side has one monotonic clock.
// Instants of the two sides have different types, so that they cannot be compared by accident. This header
// does not read a clock: the program or the laboratory supplies the time.

#include <chrono>
#include <cmath>
#include <cstdint>

namespace longreach {

using Duration = std::chrono::nanoseconds;

// The clocks are only tags; they deliberately have no now().
struct LocalClock {
  using duration = Duration;
  using rep = Duration::rep;
  using period = Duration::period;
  using time_point = std::chrono::time_point<LocalClock, Duration>;
  static constexpr bool is_steady = true;
};
struct PeerClock {
  using duration = Duration;
  using rep = Duration::rep;
  using period = Duration::period;
  using time_point = std::chrono::time_point<PeerClock, Duration>;
  static constexpr bool is_steady = true;
};

using Time = LocalClock::time_point;     // an instant on this side's monotonic clock
using PeerTime = PeerClock::time_point;  // an instant on the other side's monotonic clock

constexpr double to_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }

/// Rounds to the nearest nanosecond and saturates at ±146 years. NaN becomes zero.
inline Duration from_seconds(double s) {
  constexpr double kLimit = 4.6e9;
  if (std::isnan(s)) return Duration{0};
  if (s > kLimit) s = kLimit;
  if (s < -kLimit) s = -kLimit;
  return Duration{std::llround(s * 1e9)};
}

}  // namespace longreach
