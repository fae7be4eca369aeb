#pragma once
// Detects an increase in the delay of a link. It compares the median round-trip time over the last half
// second with the minimum of this median since the engagement; the minimum itself may rise by at most 1 ms
// per second. This detects an attacker who delays authentic datagrams in either direction, suddenly or
// gradually. Medians are used so that the minimum is not determined by a single datagram, a late tick or a
// stalled side; the median is unknown until datagrams have arrived for a quarter of a second. It is pure: the
// caller supplies the time. A delay that already existed when the engagement began is not detected.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"

namespace longreach {

class DelayWatch {
 public:
  DelayWatch();

  /// Starts an engagement: accepts the current delay, but no later increase.
  void rebase();
  /// Adds the round-trip time of a datagram. A value below zero (unknown) is ignored.
  void add(Time now, Duration rtt);
  /// Updates the median and the minimum, at most 50 times a second. Call this in each tick, after add().
  void step(Time now);

  /// Median round-trip time of the last half second; none until it is known.
  [[nodiscard]] std::optional<double> median_s() const { return median_s_; }
  /// Minimum of the median since the engagement; none until it is known.
  [[nodiscard]] std::optional<double> least_s() const { return least_s_; }
  /// Returns whether the median exceeds the minimum by more than `bound_s`.
  [[nodiscard]] bool rose(double bound_s) const {
    return median_s_ && *median_s_ - *least_s_ > bound_s;  // both are set together
  }

 private:
  struct Sample {
    Time at{};
    std::int64_t rtt_ns = 0;
  };
  [[nodiscard]] std::optional<double> median(Time now);

  Ring<Sample> samples_;
  std::vector<std::int64_t> scratch_;
  std::optional<Time> looked_at_{};
  std::optional<double> median_s_{};
  std::optional<double> least_s_{};
};

}  // namespace longreach
