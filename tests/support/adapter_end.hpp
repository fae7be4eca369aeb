#pragma once
// The adapter's end of an in-memory channel, which follows the rules of common/link/adapter_datagram.hpp.

#include <array>
#include <optional>
#include <span>

#include "common/core/time.hpp"
#include "common/link/adapter_datagram.hpp"
#include "common/wire/memory_channel.hpp"

namespace longreach {

inline Time at_ms(double ms) { return Time(from_seconds(1e-3 * ms)); }

template <class In, class Out>
struct AdapterEnd {
  Channel& channel;
  adapter::Exchange exchange{77};

  void send(Out out) {
    exchange.stamp(out);
    send_raw(out);
  }
  template <class Any>
  void send_raw(const Any& out) {
    channel.send(std::as_bytes(std::span(&out, 1)));
  }
  /// Returns the newest valid datagram, if any.
  std::optional<In> receive(Time now) {
    std::optional<In> newest;
    std::array<std::byte, 512> bytes;
    while (const auto size = channel.receive(bytes)) {
      In in;
      if (adapter::decode(bytes.data(), *size, in) &&
          exchange.accept(in.header, now.time_since_epoch().count()))
        newest = in;
    }
    return newest;
  }
};

}  // namespace longreach
