#pragma once
// What was accepted in one receive(), in order of arrival, in memory that is allocated once. When it is full
// the newest items stay.

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

  /// Forgets everything.
  void open() { size_ = next_ = 0; }

  /// Where the next item is to be written, all of it; keep() makes it one.
  T& next() { return slots_[next_]; }
  void keep() {
    next_ = next_ + 1 < slots_.size() ? next_ + 1 : 0;
    size_ = std::min(size_ + 1, slots_.size() - 1);
  }

  /// Puts the items in order; call once, after the last keep() and before items().
  void close() {
    if (next_ == size_) return;  // it never went round
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
