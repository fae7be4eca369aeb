#pragma once
// One end of the link without its bytes: numbers what leaves, judges what comes (session, replay), keeps the
// echo and the delay monitor. Pure: time comes in.
//
// Sessions: a receiver follows one session of its peer. A datagram of a greater session replaces it at once
// (the peer restarted); of a smaller one only if the present session has been silent for 1 s.

#include <array>
#include <optional>
#include <variant>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/replay_window.hpp"

namespace longreach {

class Endpoint {
 public:
  /// `session`: this side's own, non-zero, greater at each start.
  explicit Endpoint(std::uint64_t session);

  /// Header checks that need state. Nothing changes unless it is accepted by `commit`.
  [[nodiscard]] std::optional<Rejection> judge(Time now, const Header& header) const;

  /// Books a judged and decoded datagram. Returns what the receiver learns (echo translated to this clock),
  /// or the rejection (replay).
  struct Accepted {
    std::optional<Time> echo_sent{};
    bool new_session = false;
    bool newest = false;  // no newer one of its type came before
  };
  std::variant<Accepted, Rejection> commit(Time now, const Header& header, const Stamp& stamp,
                                           std::size_t bytes);

  /// Header and stamp for the next datagram.
  [[nodiscard]] Header header_for(DatagramType type, std::uint64_t sequence) const;
  [[nodiscard]] Stamp stamp_for(Time now) const;

  [[nodiscard]] const DelayMonitor& monitor() const { return monitor_; }
  [[nodiscard]] std::uint64_t session() const { return session_; }
  [[nodiscard]] std::uint64_t peer_session() const { return peer_session_; }  // 0: none yet
  /// New sessions of the peer after the first.
  [[nodiscard]] std::uint32_t peer_restarts() const { return peer_restarts_; }

 private:
  void follow(std::uint64_t peer_session);

  std::uint64_t session_;
  std::uint64_t peer_session_ = 0;
  std::uint32_t peer_restarts_ = 0;
  std::array<ReplayWindow, 3> windows_;  // one a type
  DelayMonitor monitor_;
  Time heard_at_{};  // of the datagram that is echoed: the last one that came
  PeerTime heard_sent_{};
};

}  // namespace longreach
