#pragma once
// Passes the newest value from one writing thread to one reading thread without blocking either. There are
// three slots: the writer owns one, the reader owns one, and the third is exchanged atomically. A value that
// the reader does not fetch in time is overwritten.

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

  /// Returns the newest value, or a default-constructed one before the first write. The reference is valid
  /// until the next read.
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
  std::uint32_t back_ = 0;  // slot of the writer
  std::atomic<std::uint32_t> middle_{1};
  std::uint32_t front_ = 2;  // slot of the reader
};

}  // namespace longreach
