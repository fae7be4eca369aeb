#include "master/mapping/goal_interleaver.hpp"

namespace longreach {
namespace {

constexpr double kNoise_m = 2e-5;
constexpr double kNoise_rad = 2e-4;
constexpr std::uint32_t kEvery = 8;

}  // namespace

GoalKind GoalInterleaver::next(const Goal& goal, double scale) {
  const bool translated = (goal.position_m - sent_.position_m).norm() > scale * kNoise_m;
  const bool turned = log_rotation(goal.rotation * sent_.rotation.conjugate()).norm() > scale * kNoise_rad;
  const bool rotation_first = turned && !translated;
  const bool others_turn = ++waiting_ >= kEvery;
  if (others_turn) waiting_ = 0;
  if (rotation_first != others_turn) {
    sent_.rotation = goal.rotation;
    return GoalKind::kGoalOrientation;
  }
  sent_.position_m = goal.position_m;
  return GoalKind::kGoalPosition;
}

}  // namespace longreach
