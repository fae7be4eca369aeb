#include "common/link/clock_offset.hpp"

#include <algorithm>

#include "common/link/saturating.hpp"

namespace longreach {

void ClockOffset::on_datagram(Time received, PeerTime sent) {
  const Duration transit{transit_ns(received, sent)};
  const Duration age = received - half_began_;
  if (!current_ || age >= window_ / 2) {
    // If no datagram arrived for longer than the window, the older half-window has expired as well.
    previous_ = age < window_ ? current_ : std::nullopt;
    current_ = transit;
    half_began_ = received;
    return;
  }
  current_ = std::min(*current_, transit);
}

std::optional<Time> ClockOffset::earliest_arrival(PeerTime sent) const {
  if (!current_) return std::nullopt;
  const Duration offset = previous_ ? std::min(*current_, *previous_) : *current_;
  return Time{Duration{saturating_add(to_ns(sent), offset.count())}};
}

void ClockOffset::clear() {
  current_.reset();
  previous_.reset();
}

}  // namespace longreach
