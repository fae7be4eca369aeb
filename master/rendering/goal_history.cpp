#include "master/rendering/goal_history.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {

void GoalHistory::push(std::uint64_t sequence, const Vector3& goal_m) {
  if (!goals_.empty() && sequence != first_ + goals_.size()) clear();
  if (goals_.empty()) first_ = sequence;
  if (goals_.full()) {
    ++first_;
    whole_ = false;
  }
  goals_.push(goal_m);
}

std::optional<Vector3> GoalHistory::at(double sequence) const {
  if (goals_.empty() || !(sequence >= 1.0)) return std::nullopt;
  if (sequence < static_cast<double>(first_)) return whole_ ? std::optional(goals_[0]) : std::nullopt;
  const double offset = sequence - static_cast<double>(first_);
  const double last = static_cast<double>(goals_.size() - 1);
  if (offset > last) return std::nullopt;
  const auto i = static_cast<std::size_t>(offset);
  const std::size_t j = std::min(i + 1, goals_.size() - 1);
  const double part = offset - std::floor(offset);
  return Vector3((1.0 - part) * goals_[i] + part * goals_[j]);
}

std::optional<Vector3> GoalHistory::newest() const {
  if (goals_.empty()) return std::nullopt;
  return goals_[goals_.size() - 1];
}

}  // namespace longreach
