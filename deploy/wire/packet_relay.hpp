#pragma once
// Delays and drops packets on systems whose kernel has no NFQUEUE.
// Two network namespaces are connected by TUN interfaces.
// This class forwards every IP packet from one interface to the other.

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

/// A file descriptor that is closed by the destructor.
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
  /// Creates the interface `cable` in the network namespaces of two processes.
  /// Throws a std::runtime_error with a one-sentence message if the kernel or the permissions do not allow it.
  PacketRelay(const WireConfig& config, std::array<pid_t, 2> hosts);

  /// Waits up to 0.1 s until packets arrive or become due, and processes them. Returns early on a signal.
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
      queued_datagrams_;  // packets by the end that they came from, ordered by `due`
  std::uint64_t packets_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace longreach
