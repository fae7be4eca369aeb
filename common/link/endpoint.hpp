#pragma once
// One end of the link without its bytes: numbers what leaves, judges what comes (session, replay), keeps the
// echo and the delay monitor. Pure: time comes in.
//
// Both ends follow one session at a time, which is handed to them; without one nothing leaves and nothing is
// taken. A datagram passes in three steps: `judge` changes nothing; once it has proved authentic `mark` uses
// up its number; once its values are read `learn` books what it says.

#include <array>
#include <optional>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/replay_window.hpp"

namespace longreach {

/// When the receiver of this stamp had sent what its sender had last heard; none: not known.
constexpr std::optional<Time> echo_sent(Time now, const Stamp& stamp) {
  // Nobody can have heard what this side has yet to send.
  if (!stamp.echo || stamp.echo->sent_ns > now.time_since_epoch().count()) return std::nullopt;
  return Time{Duration{stamp.echo->sent_ns}};
}

class Endpoint {
 public:
  /// Begins a session, not zero. Nothing of the one before it counts any more.
  void follow(std::uint64_t session);
  /// Ends the session; nothing is heard or numbered until the next.
  void leave();

  /// Why a datagram with this header is not taken, or none.
  [[nodiscard]] std::optional<Rejection> judge(const Header& header) const;
  /// Uses up the number of a judged, authentic header. True: no newer one of its type came before.
  bool mark(const Header& header);
  /// Books a marked datagram. Returns its round trip, below zero where it does not tell one.
  Duration learn(Time now, const Header& header, const Stamp& stamp, std::size_t bytes);

  /// Header of the next datagram. None: there is no session, or this number or a greater one of its type has
  /// left in this session, or the numbers are at their end. So no number leaves twice.
  std::optional<Header> number(DatagramType type, std::uint64_t sequence);
  [[nodiscard]] Stamp stamp_for(Time now) const;

  [[nodiscard]] const DelayMonitor& monitor() const { return monitor_; }
  [[nodiscard]] std::uint64_t session() const { return session_; }    // 0: none yet
  [[nodiscard]] std::uint32_t sessions() const { return sessions_; }  // followed so far
  /// New sessions after the first.
  [[nodiscard]] std::uint32_t restarts() const { return sessions_ == 0 ? 0 : sessions_ - 1; }

  bool operator==(const Endpoint&) const = default;

 private:
  std::uint64_t session_ = 0;
  std::uint32_t sessions_ = 0;
  std::array<std::uint64_t, kDatagramTypes> sent_{};  // greatest number that left, one a type
  std::array<ReplayWindow, kDatagramTypes> windows_;  // one a type
  DelayMonitor monitor_;
  Time received_at_{};  // of the datagram that is echoed: the last one that came
  PeerTime received_sent_{};
};

}  // namespace longreach
