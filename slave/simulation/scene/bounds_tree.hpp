#pragma once
// Finds which of many boxes contain a point: a tree of bounds that is split at the median of the longest
// side. It is built once. The cost of a query grows with the logarithm of the number of boxes and with the
// number of results.

#include <cstdint>
#include <span>
#include <vector>

#include "slave/simulation/scene/shape.hpp"

namespace longreach {

class BoundsTree {
 public:
  BoundsTree() = default;
  /// All bounds must be finite.
  explicit BoundsTree(std::span<const Bounds> bounds);

  /// Calls visit(index) for each of the bounds within reach of p, and possibly for others near it, in an
  /// order that depends only on the bounds.
  template <class Visit>
  void find(const Vector3& p, double reach_m, Visit&& visit) const {
    for (std::size_t at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      const bool here = node.bounds.within(p, reach_m);
      for (std::uint32_t i = node.first; here && i < node.last; ++i) visit(order_[i]);
      at = here ? at + 1 : node.next;
    }
  }

 private:
  struct Node {
    Bounds bounds{};
    std::uint32_t first = 0, last = 0;  // range of order_ in a leaf
    std::uint32_t next = 0;             // node after the descendants of this one
  };
  void build(std::span<const Bounds> bounds, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_;  // in depth-first order
  std::vector<std::uint32_t> order_;
};

}  // namespace longreach
