#pragma once
// Timing statistics of a loop. The lateness of the ticks is counted in fixed buckets of a quarter octave from
// 1 us, so that an update takes only a few instructions. The statistics are plain values, which are copied
// into snapshots.

#include <array>
#include <cstdint>

#include "common/core/time.hpp"

namespace longreach {

struct LoopFigures {
  static constexpr std::size_t kBuckets = 84;  // 1 us * 2^(84/4): 2 s

  std::uint64_t ticks = 0;
  /// Deadlines that were skipped because an earlier tick was late or still running.
  std::uint64_t missed_ticks = 0;
  std::uint64_t overdue_ticks = 0;  // ticks that were missed or late by more than one period
  std::uint64_t ticks_late_100ms = 0;
  Duration lateness_max{0};
  Duration busy_max{0};                            // maximum duration of a step
  std::array<std::uint32_t, kBuckets> lateness{};  // number of ticks per bucket; the last bucket is unbounded

  /// Adds a tick that started `late` after its deadline and took `busy`.
  void book(Duration late, Duration busy);
  /// Returns the number of ticks per octave of lateness: up to 1, 2, 4, ... us. The last octave is unbounded.
  [[nodiscard]] std::array<std::uint64_t, (kBuckets + 3) / 4 + 1> lateness_octaves() const;
  /// Returns the upper edge of the bucket that contains the quantile (0 to 1), s, but at most the maximum
  /// lateness. Returns 0 before the first tick.
  [[nodiscard]] double lateness_quantile_s(double quantile) const;
};

/// Deadlines at multiples of the period. After a late tick, missed deadlines are skipped instead of being
/// made up for in a burst.
class Deadlines {
 public:
  Deadlines(Time first, Duration period) : next_(first), period_(period) {}

  [[nodiscard]] Time next() const { return next_; }
  /// Advances to the next deadline and skips those that are a period or more in the past at `now`, the end of
  /// this tick. Returns the number of skipped deadlines.
  std::uint64_t advance(Time now);

 private:
  Time next_;
  Duration period_;
};

}  // namespace longreach
