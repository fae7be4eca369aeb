#pragma once
// Limits the rate at which a side sends (a token bucket): a datagram may be sent as soon as the budget has
// covered all previous datagrams. In an interval of duration T, at most rate (T + 2 ms) plus one datagram is
// sent. The byte count includes the IPv4 and UDP headers.

#include <algorithm>
#include <cstddef>

#include "common/core/time.hpp"

namespace longreach {

constexpr std::size_t kIpUdpBytes = 28;

class ByteBudget {
 public:
  /// Sets the rate, kbit/s; 0 means no limit.
  void configure(double kbit_per_s) { kbit_per_s_ = kbit_per_s; }

  /// Returns whether a datagram may be sent at `now`.
  [[nodiscard]] bool allows(Time now) const { return kbit_per_s_ <= 0.0 || now >= paid_at_; }

  /// Records a datagram with `datagram_bytes` of UDP payload as sent at `now`.
  void spend(Time now, std::size_t datagram_bytes) {
    if (kbit_per_s_ <= 0.0) return;
    const double bits = 8.0 * static_cast<double>(datagram_bytes + kIpUdpBytes);
    paid_at_ = std::max(paid_at_, now - kLate) + from_seconds(bits / (1e3 * kbit_per_s_));
  }

 private:
  // allows() is called once per tick, so credit that accrues between two ticks must not be lost.
  static constexpr Duration kLate = std::chrono::milliseconds(2);

  double kbit_per_s_ = 0.0;
  Time paid_at_{};
};

}  // namespace longreach
