#pragma once
// One end of the link without its bytes: numbers sent datagrams, checks received ones (session, replay),
// keeps the echo and the delay monitor. Pure: the caller supplies the time.
//
// Both ends use one session at a time, which the caller sets; without a session nothing is sent or accepted.
// A datagram passes three steps: `judge` changes nothing; once it is authentic, `mark` uses up its number;
// once its values are decoded, `learn` records them.

#include <array>
#include <optional>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/replay_window.hpp"

namespace longreach {

/// When the receiver of this stamp sent the newest datagram that the sender had received; none: unknown.
constexpr std::optional<Time> echo_sent(Time now, const Stamp& stamp) {
  // An echo of a datagram that this side has not sent yet is impossible.
  if (!stamp.echo || stamp.echo->sent_ns > now.time_since_epoch().count()) return std::nullopt;
  return Time{Duration{stamp.echo->sent_ns}};
}

class Endpoint {
 public:
  /// Starts a non-zero session. Data of the previous one becomes invalid.
  void follow(std::uint64_t session);
  /// Ends the session; nothing is accepted or numbered until the next one.
  void leave();

  /// Returns why a datagram with this header is rejected, or none.
  [[nodiscard]] std::optional<Rejection> judge(const Header& header) const;
  /// Uses up the number of a checked, authentic header. Returns true if no newer one of its type has arrived.
  bool mark(const Header& header);
  /// Records a marked datagram. Returns its round trip, below zero if it is unknown.
  Duration learn(Time now, const Header& header, const Stamp& stamp, std::size_t bytes);

  /// Returns the header of the next datagram. Returns none if there is no session, if this number or a
  /// greater one of its type was sent in this session, or if the numbers are exhausted. So no number is sent
  /// twice.
  std::optional<Header> number(DatagramType type, std::uint64_t sequence);
  [[nodiscard]] Stamp stamp_for(Time now) const;

  [[nodiscard]] const DelayMonitor& monitor() const { return monitor_; }
  [[nodiscard]] std::uint64_t session() const { return session_; }    // 0: none yet
  [[nodiscard]] std::uint32_t sessions() const { return sessions_; }  // sessions so far
  /// Number of sessions after the first.
  [[nodiscard]] std::uint32_t restarts() const { return sessions_ == 0 ? 0 : sessions_ - 1; }

  bool operator==(const Endpoint&) const = default;

 private:
  std::uint64_t session_ = 0;
  std::uint32_t sessions_ = 0;
  std::array<std::uint64_t, kDatagramTypes> sent_{};  // greatest sent number of each type
  std::array<ReplayWindow, kDatagramTypes> windows_;  // one per type
  DelayMonitor monitor_;
  Time received_at_{};  // arrival of the datagram that is echoed, the last one
  PeerTime received_sent_{};
};

}  // namespace longreach
