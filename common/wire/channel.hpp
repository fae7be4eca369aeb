#pragma once
// Transport of datagrams: a UDP socket in the programs, a queue in memory in the laboratory.

#include <cstddef>
#include <optional>
#include <span>

#include "common/link/origin.hpp"

namespace longreach {

class Channel {
 public:
  virtual ~Channel() = default;

  /// Receives the next datagram into `buffer` and returns its true size, which may exceed the buffer (the
  /// datagram is then truncated); none if there is none. Never waits.
  virtual std::optional<std::size_t> receive(std::span<std::byte> buffer) = 0;
  /// Origin of the datagram that receive() returned last.
  [[nodiscard]] virtual const Origin& origin() const { return kNowhere; }
  /// Sets the origin of an authentic datagram: a channel without a fixed peer sends to it from now on. All
  /// zero: it does not send.
  virtual void answer_to(const Origin&) {}

  /// Sends the datagram, or drops it if that is not possible now. Never waits.
  virtual void send(std::span<const std::byte> datagram) = 0;
};

}  // namespace longreach
