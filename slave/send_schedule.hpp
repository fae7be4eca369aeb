#pragma once
// Schedule of messages at a constant rate: late calls do not shift it, and missed calls do not accumulate.

#include <optional>

#include "common/core/time.hpp"

namespace longreach {

class SendSchedule {
 public:
  bool due(Time now, double rate_hz) {
    if (next_ && now < *next_) return false;
    const Duration period = from_seconds(1.0 / rate_hz);
    next_ = next_ && now < *next_ + period ? *next_ + period : now + period;
    return true;
  }
  void hurry() { next_.reset(); }

 private:
  std::optional<Time> next_{};
};

}  // namespace longreach
