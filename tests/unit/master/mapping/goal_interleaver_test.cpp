#include "master/mapping/goal_interleaver.hpp"

#include <gtest/gtest.h>

#include "common/core/random.hpp"

namespace longreach::goal_interleaver_test {
namespace {

int rotations_of(GoalInterleaver& interleaver, int periods, double speed_m, double speed_rad, Goal& goal,
                 double scale = 1.0) {
  int rotations = 0;
  for (int i = 0; i < periods; ++i) {
    goal.position_m.x() += speed_m;
    goal.rotation = exp_rotation({0.0, speed_rad, 0.0}) * goal.rotation;
    rotations += interleaver.next(goal, scale) == GoalKind::kGoalOrientation;
  }
  return rotations;
}

TEST(GoalInterleaver, SendsRotationEveryEighthTimeWhenBothMove) {
  GoalInterleaver interleaver;
  Goal goal;
  EXPECT_EQ(rotations_of(interleaver, 800, 1e-4, 1e-3, goal), 100);
}

TEST(GoalInterleaver, SendsRotationWhileOnlyRotationMoves) {
  GoalInterleaver interleaver;
  Goal goal;
  EXPECT_EQ(rotations_of(interleaver, 800, 0.0, 1e-3, goal), 700);
}

TEST(GoalInterleaver, SlowMotionIsNotRest) {
  GoalInterleaver interleaver;
  Goal goal;
  EXPECT_LE(rotations_of(interleaver, 8000, 5e-6, 0.0, goal, 0.05), 1000);
  EXPECT_GE(rotations_of(interleaver, 8000, 0.0, 5e-5, goal, 0.05), 5000);
}

TEST(GoalInterleaver, IgnoresNoiseOfRestingDevice) {
  GoalInterleaver interleaver;
  Goal goal;
  Random random(1);
  int rotations = 0;
  for (int i = 0; i < 800; ++i) {
    goal.position_m.x() = random.chance(0.5) ? 1e-5 : 0.0;
    goal.rotation = exp_rotation({0.0, 1e-3, 0.0}) * goal.rotation;
    rotations += interleaver.next(goal, 1.0) == GoalKind::kGoalOrientation;
  }
  EXPECT_EQ(rotations, 700);
}

TEST(GoalInterleaver, SendsPendingGoalWhenOtherRests) {
  GoalInterleaver interleaver;
  Goal goal;
  rotations_of(interleaver, 804, 1e-4, 1e-3, goal);
  EXPECT_EQ(interleaver.next(goal, 1.0), GoalKind::kGoalOrientation);
}

}  // namespace
}  // namespace longreach::goal_interleaver_test
