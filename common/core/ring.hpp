#pragma once
// A bounded queue over storage that is allocated once, at construction: the oldest element gives way when it
// is full. Index 0 is the oldest element.

#include <cstddef>
#include <vector>

#include "common/core/check.hpp"

namespace longreach {

template <class T>
class Ring {
 public:
  explicit Ring(std::size_t capacity) : slots_(capacity) { CHECK(capacity > 0); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool full() const { return size_ == slots_.size(); }

  /// Appends; drops the oldest element when full.
  void push(const T& value) {
    if (full()) pop();
    slots_[wrapped(first_ + size_)] = value;
    ++size_;
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

  bool operator==(const Ring&) const = default;  // also what lies there no longer

 private:
  /// Of an index below twice the capacity; a division would take longer than all the rest.
  [[nodiscard]] std::size_t wrapped(std::size_t i) const { return i < slots_.size() ? i : i - slots_.size(); }

  std::vector<T> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace longreach
