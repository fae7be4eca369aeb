#pragma once
// Passes the newest value from one writing thread to one reading thread without blocking either of them. Of
// three slots the writer owns one, the reader one, and the third is exchanged atomically. A value that the
// reader does not fetch in time is overwritten.

#include <array>
#include <atomic>
#include <cstdint>

namespace longreach {

template <class T>
class LatestValue {
 public:
  void write(const T& value) {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Returns the newest value, or a default value before the first write. Valid until the next read.
  const T& read() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    }
    return slots_[front_];
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;

  std::array<T, 3> slots_{};
  std::uint32_t back_ = 0;  // the writer's
  std::atomic<std::uint32_t> middle_{1};
  std::uint32_t front_ = 2;  // the reader's
};

}  // namespace longreach
