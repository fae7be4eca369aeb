#pragma once
// Delay and loss of a link where the kernel has no packet queues: a cable between two network namespaces
// whose ends are TUN interfaces; this class forwards every IP packet between them.

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "deploy/wire/wire_config.hpp"

namespace longreach {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

class PacketRelay {
 public:
  /// Makes the interface `cable` in the network namespaces of two processes. Throws std::runtime_error, one
  /// sentence, where the kernel or the rights do not permit it.
  PacketRelay(const WireConfig& config, std::array<pid_t, 2> hosts);

  /// Waits for packets and for due times, 0.1 s at most, and serves both. Returns early on a signal.
  void step();

  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct QueuedDatagram {
    Clock::time_point due{};
    std::vector<std::byte> packet;
  };

  void read(std::size_t from);
  void release(std::size_t from);

  WireConfig config_;
  Clock::duration delay_;
  std::mt19937_64 random_;
  std::array<Descriptor, 2> cable_;
  std::array<std::deque<QueuedDatagram>, 2>
      queued_datagrams_;  // by the end that they came from, due in order
  std::uint64_t packets_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace longreach
