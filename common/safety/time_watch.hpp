#pragma once
// What a side knows of time: since its tick before, and on the way of what it hears. Says when it stood still
// for longer than its gap timer, does not keep its rate, or the delay has risen. A datagram, or an echo, that
// newer ones have overtaken by more than 0.25 s is of a delay that was: it does not count. Pure: time comes
// in.

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

  /// Whether a tick now comes later than the gap timer after the one before.
  [[nodiscard]] bool stalls(Time now, double gap_s) const {
    return stepped_at_ && to_seconds(now - *stepped_at_) > gap_s;
  }

  /// What has come with this tick; before step().
  template <class Message>
  void receive(Time now, std::span<const Received<Message>> messages) {
    for (const auto& received : messages) {
      if (received.echo_sent)
        newest_echo_ = std::max(newest_echo_.value_or(*received.echo_sent), *received.echo_sent);
      const bool overtaken = received.echo_sent && *newest_echo_ - *received.echo_sent > kOvertaken;
      if (!overtaken) delay_.add(now, received.rtt);
    }
  }
  /// A tick. `overdue`: ticks so far that came late by over one period, or not at all.
  void step(Time now, double gap_s, std::uint64_t overdue) {
    stalled_since_ = stalls(now, gap_s) ? stepped_at_ : std::nullopt;
    if (stepped_at_) passed_s_ = to_seconds(now - *stepped_at_);
    stepped_at_ = now;
    overrun_.step(now, overdue);
    if (stalled_since_) overrun_.clear();
    delay_.step(now);
  }
  /// An engagement begins: it accepts the delay that is.
  void rebase() { delay_.rebase(); }

  /// Since the tick before; none at the first.
  [[nodiscard]] std::optional<double> passed_s() const { return passed_s_; }
  /// The tick before, where this one came later than the gap timer.
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
  std::optional<Time> newest_echo_{};  // of what this side has sent
};

}  // namespace longreach
