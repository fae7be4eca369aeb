#include "slave/simulation/scene/bounds_tree.hpp"

#include <algorithm>
#include <numeric>

namespace longreach {
namespace {

constexpr std::uint32_t kLeaf = 4;  // boxes that are not worth a node each

}  // namespace

BoundsTree::BoundsTree(std::span<const Bounds> bounds) : order_(bounds.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!bounds.empty()) build(bounds, 0, static_cast<std::uint32_t>(bounds.size()));
}

void BoundsTree::build(std::span<const Bounds> bounds, std::uint32_t first, std::uint32_t last) {
  const std::size_t at = nodes_.size();
  Bounds all = bounds[order_[first]];
  for (std::uint32_t i = first; i < last; ++i) all = all.with(bounds[order_[i]]);
  nodes_.push_back({all, first, first, 0});
  if (last - first <= kLeaf) {
    nodes_[at].last = last;
  } else {
    Eigen::Index side = 0;
    (all.high - all.low).maxCoeff(&side);
    const std::uint32_t middle = first + (last - first) / 2;
    const auto centre = [&](std::uint32_t i) { return bounds[i].low[side] + bounds[i].high[side]; };
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return centre(a) != centre(b) ? centre(a) < centre(b) : a < b;
                     });
    build(bounds, first, middle);
    build(bounds, middle, last);
  }
  nodes_[at].next = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace longreach
