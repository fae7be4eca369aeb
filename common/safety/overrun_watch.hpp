#pragma once
// Detects a loop that cannot keep its rate: within one second, more than half of the ticks were missed or
// late by more than one period. A single stall counts as at most half a second, because the gap timer detects
// longer stalls. Pure.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"

namespace longreach {

class OverrunWatch {
 public:
  explicit OverrunWatch(double rate_hz)
      : half_(static_cast<std::uint64_t>(0.5 * rate_hz)),
        late_(static_cast<std::size_t>(2.0 * rate_hz) + 1) {}

  /// Call this in each tick. `overdue` is the total number of ticks so far that were missed or late by more
  /// than one period.
  void step(Time now, std::uint64_t overdue) {
    const std::uint64_t more = std::min(overdue - std::min(overdue, overdue_), half_);
    overdue_ = overdue;
    while (!late_.empty() && (late_.full() || now - late_.front().at >= std::chrono::seconds(1))) {
      count_ -= late_.front().count;
      late_.pop();
    }
    if (more == 0) return;
    late_.push({now, more});
    count_ += more;
  }
  /// Discards all lateness before this call.
  void clear() {
    late_.clear();
    count_ = 0;
  }

  /// Returns whether more than half of the ticks of the last second were overdue.
  [[nodiscard]] bool overrun() const { return count_ > half_; }

 private:
  struct Late {
    Time at{};
    std::uint64_t count = 0;
  };

  std::uint64_t half_;
  Ring<Late> late_;
  std::uint64_t overdue_ = 0;
  std::uint64_t count_ = 0;  // sum of the counts in late_
};

}  // namespace longreach
