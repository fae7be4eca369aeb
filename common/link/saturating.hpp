#pragma once
// Sums and differences of nanoseconds that saturate instead of overflowing. One operand may come from the
// peer and have any value.

#include <cstdint>
#include <limits>

#include "common/core/time.hpp"

namespace longreach {

constexpr std::int64_t saturating_add(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return a < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
}

constexpr std::int64_t saturating_sub(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
}

constexpr std::int64_t to_ns(Time t) { return t.time_since_epoch().count(); }
constexpr std::int64_t to_ns(PeerTime t) { return t.time_since_epoch().count(); }

/// Returns the one-way delay plus the unknown offset between the two clocks, ns. Only differences between
/// such values are meaningful.
constexpr std::int64_t transit_ns(Time received, PeerTime sent) {
  return saturating_sub(to_ns(received), to_ns(sent));
}

}  // namespace longreach
