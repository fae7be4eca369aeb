#pragma once
// Delays and drops real packets with the kernel's NFQUEUE: the kernel stores the packets, and this class
// decides whether and when each one is forwarded.
// It applies to the network namespace of the thread that creates it.

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
  /// Throws a std::runtime_error with a one-sentence message if the kernel or the permissions do not allow
  /// it.
  PacketQueue(const WireConfig& config, std::uint16_t number);
  ~PacketQueue();
  PacketQueue(const PacketQueue&) = delete;
  PacketQueue& operator=(const PacketQueue&) = delete;

  /// Waits up to 0.1 s until packets arrive or become due, and processes them. Returns early on a signal.
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
  nfq_q_handle* queue_ = nullptr;  // owned by handle_
  /// Ordered by `due`, because all packets have the same delay.
  std::deque<QueuedDatagram> queued_datagrams_;
  std::uint64_t packets_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace longreach
