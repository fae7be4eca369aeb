#pragma once
// The only bridge between the two clocks: maps a peer's instant to this side's clock as "received at the
// earliest seen transit": offset = min over a window of (received - sent), which contains the shortest
// one-way delay. Follows drift up to 500 ppm by letting the minimum age (two half-windows). Nothing that
// stops or starts motion uses it.

#include <optional>

#include "common/core/time.hpp"

namespace longreach {

class ClockOffset {
 public:
  /// `window`: how long a minimum is believed, > 0.
  explicit ClockOffset(Duration window = std::chrono::seconds(10)) : window_(window) {}

  void on_datagram(Time received, PeerTime sent);

  /// When a datagram sent at `sent` would have arrived at the earliest; none before the first datagram.
  [[nodiscard]] std::optional<Time> earliest_arrival(PeerTime sent) const;
  void clear();

 private:
  Duration window_;
  std::optional<Duration> current_{};   // minimum of this half-window
  std::optional<Duration> previous_{};  // minimum of the one before
  Time half_began_{};
};

}  // namespace longreach
