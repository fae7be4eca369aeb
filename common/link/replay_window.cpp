#include "common/link/replay_window.hpp"

#include <algorithm>
#include <bit>

#include "common/core/check.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kWordBits = 64;

}  // namespace

// The window extends at most ceil((width - 1) / 64) words below the word of the newest number. The number of
// words is a power of two, so that an index is found without a division.
ReplayWindow::ReplayWindow(std::uint32_t width)
    : width_(width), bits_(std::bit_ceil((std::uint64_t{width} + kWordBits - 2) / kWordBits + 1)) {
  CHECK(width > 0);
}

bool ReplayWindow::fresh(std::uint64_t sequence) const {
  if (sequence > newest_) return true;
  if (sequence == 0 || newest_ - sequence >= width_) return false;
  return (bits_[place_of(sequence / kWordBits)] >> (sequence % kWordBits) & 1U) == 0;
}

bool ReplayWindow::accept(std::uint64_t sequence) {
  if (!fresh(sequence)) return false;
  const std::uint64_t word = sequence / kWordBits;
  if (sequence > newest_) {
    const std::uint64_t entered = std::min<std::uint64_t>(word - newest_ / kWordBits, bits_.size());
    for (std::uint64_t i = 0; i < entered; ++i) bits_[place_of(word - i)] = 0;
    newest_ = sequence;
  }
  bits_[place_of(word)] |= std::uint64_t{1} << (sequence % kWordBits);
  return true;
}

void ReplayWindow::clear() {
  newest_ = 0;
  std::fill(bits_.begin(), bits_.end(), 0);
}

}  // namespace longreach
