#pragma once
// History of the goals that the master commanded, by sequence number. The touch sequence that the slave
// reports selects the goal at which the surface is located. Goals are pushed in order of their numbers;
// storage is allocated once.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

/// Returns the number of goals to store, for a round trip longer than any over which a person can work.
inline std::size_t history_capacity(double send_hz) {
  constexpr double kHistory_s = 300.0;
  return static_cast<std::size_t>(std::clamp(kHistory_s * send_hz, 1024.0, 262144.0));
}

class GoalHistory {
 public:
  explicit GoalHistory(std::size_t capacity) : goals_(capacity) {}

  void clear() {
    goals_.clear();
    whole_ = true;
  }

  /// Adds a goal, m or rad. `sequence` must be one above the previous one; otherwise the history restarts.
  void push(std::uint64_t sequence, const Vector3& goal_m);

  /// Returns the goal at a fractional sequence number, interpolated linearly between two commands, or none
  /// outside the stored range. If the history is complete, a number before its start returns the first goal,
  /// because an engagement starts at the position of the robot.
  [[nodiscard]] std::optional<Vector3> at(double sequence) const;

  /// Returns whether the command is so old that its goal is no longer stored.
  [[nodiscard]] bool forgotten(double sequence) const {
    return !whole_ && sequence >= 1.0 && sequence < static_cast<double>(first_);
  }

  /// Returns the newest goal; none if the history is empty.
  [[nodiscard]] std::optional<Vector3> newest() const;

 private:
  std::uint64_t first_ = 0;  // sequence number of goals_[0]
  bool whole_ = true;        // no goal has been dropped since the start
  Ring<Vector3> goals_;
};

}  // namespace longreach
