#pragma once
// Stores the messages that one receive() accepted, in order of arrival. The memory is allocated once. If more
// messages arrive than fit, only the newest ones are kept.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "common/core/check.hpp"

namespace longreach {

template <class T>
class Inbox {
 public:
  explicit Inbox(std::size_t capacity) : slots_(capacity + 1) { CHECK(capacity > 0); }

  /// Removes all items.
  void open() { size_ = next_ = 0; }

  /// Returns the next slot. The caller writes it completely and then calls keep() to add it.
  T& next() { return slots_[next_]; }
  void keep() {
    next_ = next_ + 1 < slots_.size() ? next_ + 1 : 0;
    size_ = std::min(size_ + 1, slots_.size() - 1);
  }

  /// Sorts the items by arrival. Call this once, after the last keep() and before items().
  void close() {
    if (next_ == size_) return;  // the slots did not wrap around
    std::rotate(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>((next_ + 1) % slots_.size()),
                slots_.end());
  }

  [[nodiscard]] std::span<const T> items() const { return {slots_.data(), size_}; }

 private:
  std::vector<T> slots_;  // one more than the capacity
  std::size_t size_ = 0;
  std::size_t next_ = 0;
};

}  // namespace longreach
