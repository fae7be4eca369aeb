#pragma once
// Where datagrams go and come from: a UDP socket in the programs, a queue in memory in the laboratory.

#include <cstddef>
#include <optional>
#include <span>

namespace longreach {

class Channel {
 public:
  virtual ~Channel() = default;

  /// Takes the next datagram into `buffer` and returns its true size, which may exceed the buffer's (then it
  /// was cut); none when nothing is there. Never waits.
  virtual std::optional<std::size_t> receive(std::span<std::byte> buffer) = 0;

  /// Sends, or drops when that is not possible now. Never waits.
  virtual void send(std::span<const std::byte> datagram) = 0;
};

}  // namespace longreach
