#include "master/mapping/turns.hpp"

#include <gtest/gtest.h>

#include "common/core/random.hpp"

namespace longreach {
namespace {

int rotations_of(Turns& turns, int periods, double speed_m, double speed_rad, Goal& goal,
                 double scale = 1.0) {
  int rotations = 0;
  for (int i = 0; i < periods; ++i) {
    goal.position_m.x() += speed_m;
    goal.rotation = exp_rotation({0.0, speed_rad, 0.0}) * goal.rotation;
    rotations += turns.next(goal, scale) == GoalKind::kOrientation;
  }
  return rotations;
}

TEST(Turns, TranslationIsSentWhenBothMoveAndRotationEveryEighthTime) {
  Turns turns;
  Goal goal;
  EXPECT_EQ(rotations_of(turns, 800, 1e-4, 1e-3, goal), 100);
}

TEST(Turns, RotationIsSentWhileItAloneMoves) {
  Turns turns;
  Goal goal;
  EXPECT_EQ(rotations_of(turns, 800, 0.0, 1e-3, goal), 700);
}

TEST(Turns, ASlowMotionIsNotTakenForRest) {
  Turns turns;
  Goal goal;
  EXPECT_LE(rotations_of(turns, 8000, 5e-6, 0.0, goal, 0.05), 1000);
  EXPECT_GE(rotations_of(turns, 8000, 0.0, 5e-5, goal, 0.05), 5000);
}

TEST(Turns, NoiseOfARestingDeviceTakesNoTurns) {
  Turns turns;
  Goal goal;
  Random random(1);
  int rotations = 0;
  for (int i = 0; i < 800; ++i) {
    goal.position_m.x() = random.chance(0.5) ? 1e-5 : 0.0;
    goal.rotation = exp_rotation({0.0, 1e-3, 0.0}) * goal.rotation;
    rotations += turns.next(goal, 1.0) == GoalKind::kOrientation;
  }
  EXPECT_EQ(rotations, 700);
}

TEST(Turns, WhatWaitedIsSentAsSoonAsTheOtherRests) {
  Turns turns;
  Goal goal;
  rotations_of(turns, 804, 1e-4, 1e-3, goal);
  EXPECT_EQ(turns.next(goal, 1.0), GoalKind::kOrientation);
}

}  // namespace
}  // namespace longreach
