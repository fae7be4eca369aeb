#pragma once
// Accepts each sequence number once. Numbers that lie `width` or more below the newest are refused, because
// nobody can tell any more (RFC 6479's idea: a ring of words of bits, longer than the window).

#include <cstddef>
#include <cstdint>
#include <vector>

namespace longreach {

class ReplayWindow {
 public:
  explicit ReplayWindow(std::uint32_t width = 8192);

  /// Whether a number (>= 1) lies within or above the window and was not accepted yet.
  [[nodiscard]] bool fresh(std::uint64_t sequence) const;
  /// True if it is fresh, and never again. Zero is never accepted.
  bool accept(std::uint64_t sequence);

  [[nodiscard]] std::uint64_t newest() const { return newest_; }  // 0: none yet
  void clear();

  bool operator==(const ReplayWindow&) const = default;

 private:
  [[nodiscard]] std::size_t place_of(std::uint64_t word) const { return word & (bits_.size() - 1); }

  std::uint32_t width_;
  std::uint64_t newest_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace longreach
