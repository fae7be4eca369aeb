#pragma once
// Does a loop keep its rate? Not when more than half of the ticks of a second came late by over one period,
// or not at all. Pure: fed each tick with how many did so far. One stall counts as half a second at most:
// whether that is too long is the gap timer's to say.

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

  /// `overdue`: ticks so far that came late by over one period, or not at all.
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
  /// What was late before counts no more.
  void clear() {
    late_.clear();
    count_ = 0;
  }

  [[nodiscard]] bool overrun() const { return count_ > half_; }

 private:
  struct Late {
    Time at{};
    std::uint64_t count = 0;
  };

  std::uint64_t half_;
  Ring<Late> late_;
  std::uint64_t overdue_ = 0;
  std::uint64_t count_ = 0;  // in late_
};

}  // namespace longreach
