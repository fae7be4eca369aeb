#pragma once
// A link's delay and loss, made of real packets by the kernel's NFQUEUE: the kernel keeps the packets, this
// decides when each goes on, and whether. In the network namespace of the thread that makes it.

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>

#include "deploy/wire/wire_config.hpp"

struct nfq_handle;
struct nfq_q_handle;

namespace longreach {

class PacketQueue {
 public:
  /// Throws std::runtime_error, one sentence, where the kernel or the rights do not permit it.
  PacketQueue(const WireConfig& config, std::uint16_t number);
  ~PacketQueue();
  PacketQueue(const PacketQueue&) = delete;
  PacketQueue& operator=(const PacketQueue&) = delete;

  /// Waits for packets and for due times, 0.1 s at most, and serves both. Returns early on a signal.
  void step();

  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct QueuedDatagram {
    Clock::time_point due{};
    std::uint32_t id = 0;
  };
  struct Close {
    void operator()(nfq_handle* handle) const;
  };

  void take(std::uint32_t id);
  void read();
  void release();

  WireConfig config_;
  Clock::duration delay_;
  std::mt19937_64 random_;
  std::unique_ptr<nfq_handle, Close> handle_;
  nfq_q_handle* queue_ = nullptr;                // the handle's
  std::deque<QueuedDatagram> queued_datagrams_;  // the delay is one for all: due in order
  std::uint64_t packets_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace longreach
