#pragma once
// Relates the two clocks: maps the time at which the peer sent a datagram to the earliest possible arrival
// time on this side's clock. The offset is the minimum of (received - sent) over a window, and includes the
// shortest one-way delay. Old minima expire (two half-windows), so the offset follows a drift of up to 500
// ppm. No code that starts or stops motion uses the offset.

#include <optional>

#include "common/core/time.hpp"

namespace longreach {

class ClockOffset {
 public:
  /// `window` is the time after which a minimum expires, > 0.
  explicit ClockOffset(Duration window = std::chrono::seconds(10)) : window_(window) {}

  /// Adds the arrival of a datagram.
  void on_datagram(Time received, PeerTime sent);

  /// Returns the earliest arrival time of a datagram sent at `sent`, or none before the first datagram.
  [[nodiscard]] std::optional<Time> earliest_arrival(PeerTime sent) const;
  void clear();

 private:
  Duration window_;
  std::optional<Duration> current_{};   // minimum of the current half-window
  std::optional<Duration> previous_{};  // minimum of the previous half-window
  Time half_began_{};
};

}  // namespace longreach
