#pragma once
// Two channels that are connected in memory, for the laboratory and for tests. Datagrams that are sent at one
// end are received at the other immediately and in order. The queues are bounded: when a queue is full,
// further datagrams are dropped, as by a socket, and counted. Not thread-safe.

#include <array>
#include <cstdint>

#include "common/core/ring.hpp"
#include "common/link/header.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

class MemoryChannelPair {
 public:
  explicit MemoryChannelPair(std::size_t capacity = 2048) : ab_(capacity), ba_(capacity) {}
  MemoryChannelPair(const MemoryChannelPair&) = delete;
  MemoryChannelPair& operator=(const MemoryChannelPair&) = delete;

  Channel& a() { return a_; }
  Channel& b() { return b_; }
  [[nodiscard]] std::uint64_t dropped() const { return a_.dropped + b_.dropped; }

 private:
  /// A datagram that is too long is truncated, as by a receive buffer that is too short, but `size` is its
  /// original size.
  struct Datagram {
    std::array<std::byte, kDatagramMaxBytes> bytes;
    std::size_t size = 0;
  };
  struct End : Channel {
    End(Ring<Datagram>& in_queue, Ring<Datagram>& out_queue) : in(in_queue), out(out_queue) {}
    std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
    void send(std::span<const std::byte> datagram) override;
    Ring<Datagram>& in;
    Ring<Datagram>& out;
    std::uint64_t dropped = 0;
  };

  Ring<Datagram> ab_;
  Ring<Datagram> ba_;
  End a_{ba_, ab_};
  End b_{ab_, ba_};
};

}  // namespace longreach
