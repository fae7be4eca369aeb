#pragma once
// The only relation between the two clocks: maps an instant of the peer to the earliest possible arrival on
// this side's clock. The offset is the minimum of (received - sent) over a window, and includes the shortest
// one-way delay. Old minima expire (two half-windows), so the offset follows a drift of up to 500 ppm. It is
// not used by any code that starts or stops motion.

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
