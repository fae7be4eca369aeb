#include "common/wire/memory_channel.hpp"

#include <algorithm>

namespace longreach {

std::optional<std::size_t> MemoryChannelPair::End::receive(std::span<std::byte> buffer) {
  if (in.empty()) return std::nullopt;
  const Datagram& datagram = in.front();
  const std::size_t stored = std::min(datagram.size, datagram.bytes.size());
  std::copy_n(datagram.bytes.begin(), std::min(stored, buffer.size()), buffer.begin());
  const std::size_t size = datagram.size;
  in.pop();
  return size;
}

void MemoryChannelPair::End::send(std::span<const std::byte> datagram) {
  if (out.full()) {
    ++dropped;
    return;
  }
  Datagram slot;
  slot.size = datagram.size();
  std::copy_n(datagram.begin(), std::min(datagram.size(), slot.bytes.size()), slot.bytes.begin());
  out.push(slot);
}

}  // namespace longreach
