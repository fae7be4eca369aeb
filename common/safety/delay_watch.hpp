#pragma once
// Detects an increase of the delay of a link: compares the median round trip of the last half second with its
// minimum since the engagement, where the minimum may rise by at most 1 ms per second. An attacker that holds
// back authentic datagrams in either direction, in a step or a ramp, is detected by it. Medians are used, so
// that a single datagram, a late tick or a stalled side does not set the minimum; it is unknown until a
// quarter of a second of datagrams has arrived. Pure: the caller supplies the time. A delay that existed when
// the engagement began is not detected.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"

namespace longreach {

class DelayWatch {
 public:
  DelayWatch();

  /// Starts an engagement, which accepts the present delay but no increase from now on.
  void rebase();
  /// Adds the round trip of a datagram; below zero: unknown.
  void add(Time now, Duration rtt);
  /// Call it in each tick, after add(). It evaluates 50 times a second.
  void step(Time now);

  [[nodiscard]] std::optional<double> median_s() const { return median_s_; }  // of the last half second
  [[nodiscard]] std::optional<double> least_s() const { return least_s_; }    // since the engagement
  [[nodiscard]] bool rose(double bound_s) const {
    return median_s_ && *median_s_ - *least_s_ > bound_s;  // set together
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
