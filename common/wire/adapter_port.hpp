#pragma once
// Exchanges datagrams with an adapter (common/link/adapter_datagram.hpp) over a channel. It never blocks,
// allocates memory or throws. An invalid datagram only changes a counter.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/core/time.hpp"
#include "common/link/adapter_datagram.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

/// Statistics and current state of an adapter.
struct AdapterFigures {
  bool present = false;  // an adapter is configured
  bool silent = true;    // no datagram was received for silence_s
  bool failed = false;   // the adapter reports a failure
  std::uint64_t accepted = 0;
  std::uint64_t malformed = 0;  // datagrams that violate the protocol or contain a number that is not finite
  /// Datagrams that were overtaken or repeated, or came from another session while the current one was active.
  std::uint64_t late = 0;
  std::uint64_t restarts = 0;
  double silent_after_s = 0.0;  // time without a datagram when the last timeout was detected
  /// user that runs the listening program, if the connection was refused because of this user
  std::optional<std::uint32_t> unknown_peer{};
};

template <class Out, class In>
class AdapterPort {
 public:
  /// `channel` must outlive the port. `session` is a non-zero number that is chosen randomly at each start.
  AdapterPort(Channel& channel, std::uint64_t session, double silence_s)
      : channel_(channel), exchange_(session, from_seconds(silence_s).count()) {
    figures_.present = true;
  }

  /// Receives at most kMost datagrams. Returns whether newest() changed.
  bool receive(Time now) {
    const std::int64_t now_ns = now.time_since_epoch().count();
    bool fresh = false;
    std::array<std::byte, sizeof(In)> bytes;
    for (int i = 0; i < kMost; ++i) {
      const auto size = channel_.receive(bytes);
      if (!size) break;
      In in;
      if (!adapter::decode(bytes.data(), *size, in)) {
        ++figures_.malformed;
      } else if (!exchange_.accept(in.header, now_ns)) {
        ++figures_.late;
      } else {
        ++figures_.accepted;
        newest_ = in;
        fresh = true;
      }
    }
    if (fresh) received_ = now;
    const bool silent = exchange_.silent(now_ns);
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
  [[nodiscard]] const AdapterFigures& figures() const { return figures_; }

 private:
  static constexpr int kMost = 256;

  Channel& channel_;
  adapter::Exchange exchange_;
  In newest_{};
  Time received_{};
  AdapterFigures figures_{};
};

}  // namespace longreach
