#pragma once
// This side's end of the exchange with an adapter (common/link/adapter_datagram.hpp) over a channel. It never
// waits, allocates nothing, throws nothing. An invalid datagram changes nothing except a counter.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/core/time.hpp"
#include "common/link/adapter_datagram.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

/// Statistics and present state of an adapter.
struct AdapterFigures {
  bool present = false;  // an adapter is configured
  bool silent = true;    // no datagram for silence_s
  bool failed = false;   // the adapter reports a failure
  std::uint64_t accepted = 0;
  std::uint64_t malformed = 0;  // not of this protocol, or with a number that is not finite
  std::uint64_t late = 0;       // overtaken, repeated, or of another session during one
  std::uint64_t restarts = 0;
  double silent_after_s = 0.0;  // duration of the last silence when it became a fault
  /// the other user to which the listening program belongs, if it is refused
  std::optional<std::uint32_t> unknown_peer{};
};

template <class Out, class In>
class AdapterPort {
 public:
  /// `channel` must outlive the port. `session`: random at each start, not 0.
  AdapterPort(Channel& channel, std::uint64_t session, double silence_s)
      : channel_(channel), exchange_(session, from_seconds(silence_s).count()) {
    figures_.present = true;
  }

  /// Receives at most kMost datagrams. Returns true if newest() has changed.
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

  /// At the last receive(): datagrams arrive and the adapter reports no failure.
  [[nodiscard]] bool ok() const { return !figures_.silent && !figures_.failed; }
  [[nodiscard]] const In& newest() const { return newest_; }
  /// Time since it was received.
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
