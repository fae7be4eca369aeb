#pragma once
// Monitors the timing of a side: the time since its previous tick, and the delay of received datagrams. It
// reports stalls longer than the gap timer, a loop that cannot keep its rate, and an increased delay. A
// datagram with an echo more than 0.25 s older than the newest echo reflects a past delay and is ignored. It
// is pure: the caller supplies the time.

#include <algorithm>
#include <optional>
#include <span>

#include "common/link/envelope.hpp"
#include "common/safety/delay_watch.hpp"
#include "common/safety/overrun_watch.hpp"

namespace longreach {

class TimeWatch {
 public:
  explicit TimeWatch(double rate_hz) : overrun_(rate_hz) {}

  /// Returns whether a tick at `now` would come more than `gap_s` after the previous tick.
  [[nodiscard]] bool stalls(Time now, double gap_s) const {
    return stepped_at_ && to_seconds(now - *stepped_at_) > gap_s;
  }

  /// Processes the datagrams received in this tick. Call this before step().
  template <class Message>
  void receive(Time now, std::span<const Received<Message>> messages) {
    for (const auto& received : messages) {
      if (received.echo_sent)
        newest_echo_ = std::max(newest_echo_.value_or(*received.echo_sent), *received.echo_sent);
      const bool overtaken = received.echo_sent && *newest_echo_ - *received.echo_sent > kOvertaken;
      if (!overtaken) delay_.add(now, received.rtt);
    }
  }
  /// Processes a tick. `overdue` is the total number of ticks so far that were missed or late by more than
  /// one period.
  void step(Time now, double gap_s, std::uint64_t overdue) {
    stalled_since_ = stalls(now, gap_s) ? stepped_at_ : std::nullopt;
    if (stepped_at_) passed_s_ = to_seconds(now - *stepped_at_);
    stepped_at_ = now;
    overrun_.step(now, overdue);
    if (stalled_since_) overrun_.clear();
    delay_.step(now);
  }
  /// Starts an engagement: accepts the current delay.
  void rebase() { delay_.rebase(); }

  /// Returns the time from the previous tick to this one; none at the first tick.
  [[nodiscard]] std::optional<double> passed_s() const { return passed_s_; }
  /// Returns the time of the previous tick if this one came later than the gap timer allows; otherwise none.
  [[nodiscard]] std::optional<Time> stalled_since() const { return stalled_since_; }
  [[nodiscard]] bool overrun() const { return overrun_.overrun(); }
  [[nodiscard]] const DelayWatch& delay() const { return delay_; }

 private:
  static constexpr Duration kOvertaken = std::chrono::milliseconds(250);

  OverrunWatch overrun_;
  DelayWatch delay_;
  std::optional<Time> stepped_at_{};
  std::optional<Time> stalled_since_{};
  std::optional<double> passed_s_{};
  std::optional<Time> newest_echo_{};  // send time of the newest datagram of this side that was echoed
};

}  // namespace longreach
