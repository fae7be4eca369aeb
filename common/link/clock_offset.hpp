#pragma once
// The only link between the two clocks: maps an instant of the peer to the clock of this side as the earliest
// possible arrival: offset = min over a window of (received - sent), which includes the shortest one-way
// delay. It follows drift up to 500 ppm by aging the minimum (two half-windows). Nothing that stops or starts
// motion uses it.

#include <optional>

#include "common/core/time.hpp"

namespace longreach {

class ClockOffset {
 public:
  /// `window`: validity of a minimum, > 0.
  explicit ClockOffset(Duration window = std::chrono::seconds(10)) : window_(window) {}

  void on_datagram(Time received, PeerTime sent);

  /// Returns the earliest arrival time of a datagram sent at `sent`; none before the first datagram.
  [[nodiscard]] std::optional<Time> earliest_arrival(PeerTime sent) const;
  void clear();

 private:
  Duration window_;
  std::optional<Duration> current_{};   // minimum of this half-window
  std::optional<Duration> previous_{};  // minimum of the one before
  Time half_began_{};
};

}  // namespace longreach
