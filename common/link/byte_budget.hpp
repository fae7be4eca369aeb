#pragma once
// Limits the rate at which a side sends: a datagram may leave when the previous ones are paid for. In any
// time T at most rate (T + 2 ms) plus one datagram are sent. The byte count includes the IPv4 and UDP
// headers.

#include <algorithm>
#include <cstddef>

#include "common/core/time.hpp"

namespace longreach {

constexpr std::size_t kIpUdpBytes = 28;

class ByteBudget {
 public:
  /// Rate in kbit/s; 0: no limit.
  void configure(double kbit_per_s) { kbit_per_s_ = kbit_per_s; }

  [[nodiscard]] bool allows(Time now) const { return kbit_per_s_ <= 0.0 || now >= paid_at_; }

  void spend(Time now, std::size_t datagram_bytes) {
    if (kbit_per_s_ <= 0.0) return;
    const double bits = 8.0 * static_cast<double>(datagram_bytes + kIpUdpBytes);
    paid_at_ = std::max(paid_at_, now - kLate) + from_seconds(bits / (1e3 * kbit_per_s_));
  }

 private:
  // Called once per tick: credit that accrues between two ticks is kept.
  static constexpr Duration kLate = std::chrono::milliseconds(2);

  double kbit_per_s_ = 0.0;
  Time paid_at_{};
};

}  // namespace longreach
