#pragma once
// Stop on a way of its own from any thread to the loop: a level that the next tick reads, beside the mailbox
// and behind no lock. The loop's side is two atomic operations.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace longreach {

class StopLevel {
 public:
  /// Whether a tick took it within `timeout`. It stands besides: a loop that comes later takes it then.
  bool ask(std::chrono::milliseconds timeout) {
    const std::uint64_t own = asked_.fetch_add(1, std::memory_order_acq_rel) + 1;
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (taken_.load(std::memory_order_acquire) < own) {
      if (std::chrono::steady_clock::now() >= deadline) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
  }

  /// Loop side: whether to stop in this tick.
  bool take() {
    const std::uint64_t asked = asked_.load(std::memory_order_acquire);
    if (asked == taken_.load(std::memory_order_relaxed)) return false;
    taken_.store(asked, std::memory_order_release);
    return true;
  }

 private:
  std::atomic<std::uint64_t> asked_{0};
  std::atomic<std::uint64_t> taken_{0};  // of those asked; written by the loop alone
};

}  // namespace longreach
