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
  explicit Inbox(std::size_t capacity) : slots_(capacity) { CHECK(capacity > 0); }

  /// Forgets everything.
  void open() { size_ = oldest_ = 0; }

  void push(const T& item) {
    if (size_ < slots_.size()) {
      slots_[size_++] = item;
      return;
    }
    slots_[oldest_] = item;
    oldest_ = (oldest_ + 1) % slots_.size();
  }

  /// Puts the items in order; call once, after the last push and before items().
  void close() {
    if (oldest_ == 0) return;
    std::rotate(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(oldest_),
                slots_.begin() + static_cast<std::ptrdiff_t>(size_));
    oldest_ = 0;
  }

  [[nodiscard]] std::span<const T> items() const { return {slots_.data(), size_}; }

 private:
  std::vector<T> slots_;
  std::size_t size_ = 0;
  std::size_t oldest_ = 0;
};

}  // namespace longreach
