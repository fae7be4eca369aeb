#pragma once
// Has the delay of a link risen? Compares the median round trip of the last half second with its least since
// the engagement, which may rise by 1 ms a second at most: whoever holds authentic datagrams back, either
// way, in a step or a ramp, shows in it. Medians, so that no single datagram, a late tick or a side that
// stood still sets the least; none is known before datagrams of a quarter of a second have told one. Pure:
// time comes in. Does not see a delay that was there when the engagement began.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"

namespace longreach {

class DelayWatch {
 public:
  DelayWatch();

  /// An engagement begins: it accepts the delay that is, and none that comes in the next moment.
  void rebase();
  /// A datagram has told a round trip; below zero: it has not.
  void add(Time now, Duration rtt);
  /// Each tick, after the datagrams. Looks 50 times a second.
  void step(Time now);

  [[nodiscard]] std::optional<double> median_s() const { return median_s_; }  // of the last half second
  [[nodiscard]] std::optional<double> least_s() const { return least_s_; }    // since the engagement
  [[nodiscard]] bool rose(double bound_s) const {
    return median_s_ && *median_s_ - *least_s_ > bound_s;  // none without the other
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
