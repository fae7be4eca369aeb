#pragma once
// Which goal was sent with which command: the master's own motion, in which the slave's touch sequence finds
// the place of the surface. Sequences are pushed one after the other; storage is allocated once.

#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

class GoalHistory {
 public:
  explicit GoalHistory(std::size_t capacity) : goals_(capacity) {}

  void clear() {
    goals_.clear();
    whole_ = true;
  }

  /// `sequence` must be one above the last one; otherwise the history starts anew.
  void push(std::uint64_t sequence, const Vector3& goal_m);

  /// Goal at a fractional sequence, linear between two commands; none outside of what is remembered. What was
  /// commanded before the history began is its first goal: an engagement begins where the robot is.
  [[nodiscard]] std::optional<Vector3> at(double sequence) const;

  /// It was commanded, but too long ago to be remembered.
  [[nodiscard]] bool forgotten(double sequence) const {
    return !whole_ && sequence >= 1.0 && sequence < static_cast<double>(first_);
  }

  [[nodiscard]] std::optional<Vector3> newest() const;

 private:
  std::uint64_t first_ = 0;  // sequence of goals_[0]
  bool whole_ = true;        // nothing has been dropped since it began
  Ring<Vector3> goals_;
};

}  // namespace longreach
