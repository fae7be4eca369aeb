#pragma once
// Passes a stop request from any thread to the loop, independently of the mailbox and of any lock: the next
// tick reads a flag. The loop side uses only two atomic operations.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace longreach {

class StopLevel {
 public:
  /// Requests a stop and returns whether a tick took it within `timeout`. If not, the next tick still takes
  /// it.
  bool ask(std::chrono::milliseconds timeout) {
    const std::uint64_t own = asked_.fetch_add(1, std::memory_order_acq_rel) + 1;
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (taken_.load(std::memory_order_acquire) < own) {
      if (std::chrono::steady_clock::now() >= deadline) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
  }

  /// Loop side: returns whether a stop was requested since the last call.
  bool take() {
    const std::uint64_t asked = asked_.load(std::memory_order_acquire);
    if (asked == taken_.load(std::memory_order_relaxed)) return false;
    taken_.store(asked, std::memory_order_release);
    return true;
  }

 private:
  std::atomic<std::uint64_t> asked_{0};
  std::atomic<std::uint64_t> taken_{0};  // number of requests taken; written only by the loop
};

}  // namespace longreach
