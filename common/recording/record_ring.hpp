#pragma once
// A bounded queue from one writing thread to one reading thread. Its memory is allocated once. Neither thread
// waits for the other, uses locks or makes system calls. The writer checks for space, fills slots and
// publishes them; if there is no space, it must drop the record.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/check.hpp"

namespace longreach {

template <class T>
class RecordRing {
 public:
  explicit RecordRing(std::size_t capacity) : slots_(capacity) { CHECK(capacity > 0); }

  /// Writer: returns the number of free slots. At least this number remains free until the next publish().
  [[nodiscard]] std::size_t room() const {
    return slots_.size() - static_cast<std::size_t>(written_.load(std::memory_order_relaxed) + pending_ -
                                                    read_.load(std::memory_order_acquire));
  }
  /// Writer: returns the next free slot. Requires room() > 0.
  T& next() { return slots_[(written_.load(std::memory_order_relaxed) + pending_++) % slots_.size()]; }
  /// Writer: publishes the slots that were filled since the last call.
  void publish() {
    written_.store(written_.load(std::memory_order_relaxed) + pending_, std::memory_order_release);
    pending_ = 0;
  }

  /// Reader: returns the oldest record, or none.
  [[nodiscard]] const T* front() const {
    const std::uint64_t at = read_.load(std::memory_order_relaxed);
    return at == written_.load(std::memory_order_acquire) ? nullptr : &slots_[at % slots_.size()];
  }
  void pop() { read_.store(read_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

 private:
  std::vector<T> slots_;
  alignas(64) std::atomic<std::uint64_t> written_{0};
  std::uint64_t pending_ = 0;  // slots that the writer filled but did not publish yet
  alignas(64) std::atomic<std::uint64_t> read_{0};
};

}  // namespace longreach
