#pragma once
// Finds which of many boxes contain a point: a tree of bounds, split at the median of the longest side. Built
// once; the cost of a query is the logarithm of the number of boxes plus its results.

#include <cstdint>
#include <span>
#include <vector>

#include "slave/scene/shape.hpp"

namespace longreach {

class BoundsTree {
 public:
  BoundsTree() = default;
  /// Finite bounds.
  explicit BoundsTree(std::span<const Bounds> bounds);

  /// Calls visit(index) for each of the bounds within reach of p, in an order that depends only on the
  /// bounds, possibly also for others near it.
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
    std::uint32_t first = 0, last = 0;  // of order_, in a leaf
    std::uint32_t next = 0;             // the node after this one's children
  };
  void build(std::span<const Bounds> bounds, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_;  // depth first
  std::vector<std::uint32_t> order_;
};

}  // namespace longreach
