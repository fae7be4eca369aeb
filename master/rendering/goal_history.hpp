#pragma once
// Goals by command: the motion of the master, in which the slave's touch sequence locates the surface.
// Sequences are pushed in order; storage is allocated once.

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

  /// `sequence` must be one above the last one; otherwise the history restarts.
  void push(std::uint64_t sequence, const Vector3& goal_m);

  /// Returns the goal at a fractional sequence, linear between two commands; none outside the stored range.
  /// For commands before the start of the history it is the first goal, because an engagement starts at the
  /// position of the robot.
  [[nodiscard]] std::optional<Vector3> at(double sequence) const;

  /// Returns whether the command was sent too long ago to be stored.
  [[nodiscard]] bool forgotten(double sequence) const {
    return !whole_ && sequence >= 1.0 && sequence < static_cast<double>(first_);
  }

  [[nodiscard]] std::optional<Vector3> newest() const;

 private:
  std::uint64_t first_ = 0;  // sequence of goals_[0]
  bool whole_ = true;        // nothing has been dropped since the start
  Ring<Vector3> goals_;
};

}  // namespace longreach
