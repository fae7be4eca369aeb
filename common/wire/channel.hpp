#pragma once
// Where datagrams go and come from: a UDP socket in the programs, a queue in memory in the laboratory.

#include <cstddef>
#include <optional>
#include <span>

#include "common/link/origin.hpp"

namespace longreach {

class Channel {
 public:
  virtual ~Channel() = default;

  /// Takes the next datagram into `buffer` and returns its true size, which may exceed the buffer's (then it
  /// was cut); none when nothing is there. Never waits.
  virtual std::optional<std::size_t> receive(std::span<std::byte> buffer) = 0;
  /// Where the datagram came from that receive() took last.
  [[nodiscard]] virtual const Origin& origin() const { return kNowhere; }
  /// An authentic datagram came from there: a channel without a fixed peer sends there from now on. All zero:
  /// it sends nowhere.
  virtual void answer_to(const Origin&) {}

  /// Sends, or drops when that is not possible now. Never waits.
  virtual void send(std::span<const std::byte> datagram) = 0;
};

}  // namespace longreach
