#pragma once
// One end of the link without the encoding of datagrams: numbers sent datagrams, checks received ones (session,
// replay), and maintains the echo and the delay monitor. The class is pure: the caller supplies the time.
//
// Both ends use one session at a time, which the caller sets; without a session nothing is sent or accepted.
// A received datagram goes through three steps: `judge` checks the header and changes nothing; after
// authentication, `mark` marks its sequence number as used; after decoding, `learn` records its timing.

#include <array>
#include <optional>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/replay_window.hpp"

namespace longreach {

/// Returns when this side sent the newest datagram that the sender of `stamp` had received; none if unknown.
constexpr std::optional<Time> echo_sent(Time now, const Stamp& stamp) {
  // An echo of a datagram that this side has not sent yet is impossible.
  if (!stamp.echo || stamp.echo->sent_ns > now.time_since_epoch().count()) return std::nullopt;
  return Time{Duration{stamp.echo->sent_ns}};
}

class Endpoint {
 public:
  /// Starts a session; `session` must not be 0. All data of the previous session is discarded.
  void follow(std::uint64_t session);
  /// Ends the session. Nothing is accepted or numbered until the next session.
  void leave();

  /// Returns why a datagram with this header is rejected, or none if it is acceptable.
  [[nodiscard]] std::optional<Rejection> judge(const Header& header) const;
  /// Marks the sequence number of a checked, authentic header as used. Returns whether no newer datagram of
  /// this type has arrived.
  bool mark(const Header& header);
  /// Records the timing of a marked datagram. Returns its round-trip time, or a negative value if it is
  /// unknown.
  Duration learn(Time now, const Header& header, const Stamp& stamp, std::size_t bytes);

  /// Returns the header of the next datagram. Returns none if there is no session, if this number or a
  /// greater one of the same type was already sent in this session, or if the numbers are exhausted.
  /// Therefore no number is sent twice.
  std::optional<Header> number(DatagramType type, std::uint64_t sequence);
  /// Returns the stamp of a datagram that is sent at `now`.
  [[nodiscard]] Stamp stamp_for(Time now) const;

  [[nodiscard]] const DelayMonitor& monitor() const { return monitor_; }
  /// This side was stalled: the datagrams that it has missed do not count as lost.
  void skip_stall() { monitor_.skip_stall(); }
  [[nodiscard]] std::uint64_t session() const { return session_; }    // 0: no session
  [[nodiscard]] std::uint32_t sessions() const { return sessions_; }  // number of sessions so far
  /// Returns the number of sessions after the first.
  [[nodiscard]] std::uint32_t restarts() const { return sessions_ == 0 ? 0 : sessions_ - 1; }

  bool operator==(const Endpoint&) const = default;

 private:
  std::uint64_t session_ = 0;
  std::uint32_t sessions_ = 0;
  std::array<std::uint64_t, kDatagramTypes> sent_{};  // greatest number sent, per type
  std::array<ReplayWindow, kDatagramTypes> windows_;  // one window per type
  DelayMonitor monitor_;
  Time received_at_{};  // arrival of the last datagram, which is echoed
  PeerTime received_sent_{};
};

}  // namespace longreach
