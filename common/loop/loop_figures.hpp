#pragma once
// Timing statistics of a loop: lateness of its ticks in fixed buckets of a quarter octave from 1 us, so that
// an update costs a few instructions. Plain values, which are copied into snapshots.

#include <array>
#include <cstdint>

#include "common/core/time.hpp"

namespace longreach {

struct LoopFigures {
  static constexpr std::size_t kBuckets = 84;  // 1 us * 2^(84/4): 2 s

  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks =
      0;  // deadlines that were skipped because an earlier tick was still running or late
  std::uint64_t overdue_ticks = 0;  // ticks that were late by more than one period, or missed
  std::uint64_t ticks_late_100ms = 0;
  Duration lateness_max{0};
  Duration busy_max{0};                            // longest step
  std::array<std::uint32_t, kBuckets> lateness{};  // ticks by lateness; the last bucket is unbounded

  void book(Duration late, Duration busy);
  /// Ticks by lateness in octaves: up to 1, 2, 4, ... us; the last one is unbounded.
  [[nodiscard]] std::array<std::uint64_t, (kBuckets + 3) / 4 + 1> lateness_octaves() const;
  /// Upper edge of the bucket that contains the quantile (0 to 1), s; at most the maximum. 0 before the first
  /// tick.
  [[nodiscard]] double lateness_quantile_s(double quantile) const;
};

/// Deadlines at multiples of the period. A late tick skips the missed deadlines instead of catching up in a
/// burst.
class Deadlines {
 public:
  Deadlines(Time first, Duration period) : next_(first), period_(period) {}

  [[nodiscard]] Time next() const { return next_; }
  /// Moves to the next deadline; `now` is the end of this tick. Returns the number of skipped deadlines.
  std::uint64_t advance(Time now);

 private:
  Time next_;
  Duration period_;
};

}  // namespace longreach
