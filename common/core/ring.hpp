#pragma once
// A bounded queue in storage that is allocated once, at construction. When it is full, a new element replaces
// the oldest one. Index 0 is the oldest element.
//
// The queue cycles through only part of its storage, and doubles that part (up to the capacity) when it is
// full. A large but mostly empty ring therefore stays in the cache.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/core/check.hpp"

namespace longreach {

template <class T>
class Ring {
 public:
  explicit Ring(std::size_t capacity) : slots_(capacity), round_(std::min(capacity, kFirstRound)) {
    CHECK(capacity > 0);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool full() const { return size_ == slots_.size(); }

  /// Appends an element; drops the oldest one when full.
  void push(const T& value) { extend() = value; }
  /// Appends an element for the caller to fill in. It initially has the content of an older element.
  T& extend() {
    if (full()) pop();
    if (size_ == round_) widen();
    return slots_[wrapped(first_ + size_++)];
  }
  void pop() {
    CHECK(size_ > 0);
    first_ = wrapped(first_ + 1);
    --size_;
  }
  void clear() { first_ = size_ = 0; }

  T& operator[](std::size_t i) { return slots_[wrapped(first_ + i)]; }
  const T& operator[](std::size_t i) const { return slots_[wrapped(first_ + i)]; }
  [[nodiscard]] const T& front() const { return (*this)[0]; }
  [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }

  bool operator==(const Ring&) const = default;  // compares unused slots, too

 private:
  static constexpr std::size_t kFirstRound = 64;

  /// Wraps an index that is less than twice round_. A division here would dominate the run time.
  [[nodiscard]] std::size_t wrapped(std::size_t i) const { return i < round_ ? i : i - round_; }
  void widen() {
    const auto begin = slots_.begin();
    std::rotate(begin, begin + static_cast<std::ptrdiff_t>(first_),
                begin + static_cast<std::ptrdiff_t>(round_));
    first_ = 0;
    round_ = std::min(2 * round_, slots_.size());
  }

  std::vector<T> slots_;
  std::size_t round_;  // slots in use
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace longreach
