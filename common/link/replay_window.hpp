#pragma once
// Accepts each sequence number once. Numbers that are `width` or more below the newest are rejected, because
// their state is no longer stored (idea of RFC 6479: a ring of bit words that is longer than the window).

#include <cstddef>
#include <cstdint>
#include <vector>

namespace longreach {

class ReplayWindow {
 public:
  explicit ReplayWindow(std::uint32_t width = 8192);

  /// Returns whether `sequence` (>= 1) is within or above the window and has not been accepted yet.
  [[nodiscard]] bool fresh(std::uint64_t sequence) const;
  /// Returns true for a new number and marks it as used. Zero is always rejected.
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
