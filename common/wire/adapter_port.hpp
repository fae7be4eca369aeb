#pragma once
// Exchanges datagrams with an adapter (common/link/adapter_datagram.hpp) over a channel. It never blocks,
// allocates memory or throws. An invalid datagram only changes a counter.
//
// An adapter may send a second kind of datagram beside its state, `Extra`: for a robot, the poses of the bodies
// that it tracks. It is numbered with the state. The port is silent if no state arrives, whatever else does.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>

#include "common/core/time.hpp"
#include "common/link/adapter_datagram.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

/// Statistics and current state of an adapter.
struct AdapterFigures {
  bool present = false;         // an adapter is configured
  bool silent = true;           // no datagram was received for silence_s
  bool failed = false;          // the adapter reports a failure
  std::uint64_t accepted = 0;   // datagrams of the state of the device or robot
  std::uint64_t malformed = 0;  // datagrams that violate the protocol or contain a number that is not finite
  /// Datagrams that were overtaken or repeated, or came from another session while the current one was active.
  std::uint64_t late = 0;
  std::uint64_t restarts = 0;
  double silent_after_s = 0.0;  // time without a datagram when the last timeout was detected
  /// user that runs the listening program, if the connection was refused because of this user
  std::optional<std::uint32_t> unknown_peer{};
};

template <class Out, class In, class Extra = std::monostate>
class AdapterPort {
 public:
  /// `channel` must outlive the port. `session` is a non-zero number that is chosen randomly at each start.
  AdapterPort(Channel& channel, std::uint64_t session, double silence_s)
      : channel_(channel),
        silence_(from_seconds(silence_s)),
        exchange_(session, from_seconds(silence_s).count()) {
    figures_.present = true;
  }

  /// Receives at most kMost datagrams. Returns whether newest() changed.
  bool receive(Time now) {
    const std::uint64_t before = figures_.accepted;
    std::array<std::byte, std::max(sizeof(In), sizeof(Extra))> bytes;
    for (int i = 0; i < kMost; ++i) {
      const auto size = channel_.receive(bytes);
      if (!size) break;
      take(bytes.data(), *size, now);
    }
    const bool fresh = figures_.accepted > before;
    if (fresh) received_ = now;
    const bool silent = figures_.accepted == 0 || now - received_ >= silence_;
    if (silent && !figures_.silent) figures_.silent_after_s = to_seconds(now - received_);
    figures_.silent = silent;
    figures_.failed = !figures_.silent && (newest_.flags & In::kOk) == 0;
    figures_.restarts = exchange_.sessions() > 0 ? exchange_.sessions() - 1 : 0;
    return fresh;
  }

  void send(Out out) {
    exchange_.stamp(out);
    channel_.send(std::as_bytes(std::span(&out, 1)));
  }

  /// Returns whether, at the last receive(), datagrams were arriving and the adapter reported no failure.
  [[nodiscard]] bool ok() const { return !figures_.silent && !figures_.failed; }
  [[nodiscard]] const In& newest() const { return newest_; }
  /// Returns the time since newest() was received.
  [[nodiscard]] double age_s(Time now) const { return to_seconds(now - received_); }
  /// Returns the newest extra datagram of the present session of the adapter; none if it has sent none.
  [[nodiscard]] const std::optional<Extra>& newest_extra() const { return extra_; }
  /// Returns the time since newest_extra() was received.
  [[nodiscard]] double extra_age_s(Time now) const { return to_seconds(now - extra_received_); }
  [[nodiscard]] const AdapterFigures& figures() const { return figures_; }

 private:
  static constexpr int kMost = 256;

  void take(const std::byte* bytes, std::size_t size, Time now) {
    if (In in; adapter::decode(bytes, size, in)) {
      if (!accept(in.header, now)) return;
      ++figures_.accepted;
      newest_ = in;
      return;
    }
    if constexpr (!std::is_same_v<Extra, std::monostate>) {
      if (Extra extra; adapter::decode(bytes, size, extra)) {
        if (!accept(extra.header, now)) return;
        extra_ = extra;
        extra_received_ = now;
        return;
      }
    }
    ++figures_.malformed;
  }

  bool accept(const adapter::Header& header, Time now) {
    const std::uint64_t sessions = exchange_.sessions();
    if (!exchange_.accept(header, now.time_since_epoch().count())) {
      ++figures_.late;
      return false;
    }
    if (exchange_.sessions() != sessions) extra_.reset();
    return true;
  }

  Channel& channel_;
  Duration silence_;
  adapter::Exchange exchange_;
  In newest_{};
  Time received_{};
  std::optional<Extra> extra_{};
  Time extra_received_{};
  AdapterFigures figures_{};
};

}  // namespace longreach
