#pragma once
// Transport of datagrams: a UDP socket in the programs, or a queue in memory in the laboratory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/link/origin.hpp"

namespace longreach {

class Channel {
 public:
  virtual ~Channel() = default;

  /// Receives the next datagram into `buffer`. Returns its original size, which exceeds the size of the
  /// buffer if the datagram was truncated, or none if there is no datagram. Never blocks.
  virtual std::optional<std::size_t> receive(std::span<std::byte> buffer) = 0;
  /// Returns the origin of the last datagram that receive() returned.
  [[nodiscard]] virtual const Origin& origin() const { return kNowhere; }
  /// Reports the origin of an authentic datagram. From then on, a channel without a fixed peer sends to this
  /// address, or does not send if the address is all zero.
  virtual void answer_to(const Origin&) {}

  /// Sends the datagram, or drops it if it cannot be sent immediately. Never blocks.
  virtual void send(std::span<const std::byte> datagram) = 0;

  /// Number of dropped datagrams from addresses other than the peer's.
  [[nodiscard]] virtual std::uint64_t unknown_peers() const { return 0; }
  /// Number of datagrams that the system refused to send.
  [[nodiscard]] virtual std::uint64_t unsent() const { return 0; }
};

}  // namespace longreach
