#include "master/input/keys.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach::keys_test {
namespace {

Key moved(int axis, int sign, bool large = false) { return {KeyAction::kMove, axis, sign, large}; }

TEST(Keys, MoveTheTargetInSteps) {
  KeyboardState state;
  const KeyboardConfig config;
  apply(moved(0, 1), config, MotionMode::kPosition, state);
  apply(moved(2, -1, true), config, MotionMode::kPosition, state);
  EXPECT_TRUE(state.target_m.isApprox(Vector3(0.001, 0.0, -0.005)));
  apply({KeyAction::kHome}, config, MotionMode::kPosition, state);
  EXPECT_EQ(state.target_m, Vector3::Zero());
}

TEST(Keys, TurnTheTargetInStepsWithinTheWorkspace) {
  KeyboardState state;
  const KeyboardConfig config;
  apply({KeyAction::kTurn, 0, 1}, config, MotionMode::kPosition, state);
  apply({KeyAction::kTurn, 2, -1, true}, config, MotionMode::kPosition, state);
  EXPECT_TRUE(state.target_rad.isApprox(Vector3(0.01, 0.0, -0.05)));
  EXPECT_EQ(state.target_m, Vector3::Zero());
  for (int i = 0; i < 100; ++i) apply({KeyAction::kTurn, 1, 1, true}, config, MotionMode::kPosition, state);
  EXPECT_NEAR(state.target_rad.norm(), config.workspace_rad, 1e-12);
  apply({KeyAction::kHome}, config, MotionMode::kPosition, state);
  EXPECT_EQ(state.target_rad, Vector3::Zero());
}

TEST(Keys, KeepTheTargetWithinTheWorkspace) {
  Random random(5);
  KeyboardState state;
  const KeyboardConfig config;
  for (int i = 0; i < 5000; ++i) {
    const int axis = static_cast<int>(random.next() % 3);
    apply(moved(axis, random.chance(0.7) ? 1 : -1, random.chance(0.5)), config, MotionMode::kPosition, state);
    ASSERT_LE(state.target_m.norm(), config.workspace_m * (1.0 + 1e-12));
  }
  EXPECT_GT(state.target_m.norm(), 0.9 * config.workspace_m);
}

TEST(Keys, ChangeTheModeFromThePresentOne) {
  KeyboardState state;
  apply({KeyAction::kMode}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.mode, MotionMode::kPosition);
  apply({KeyAction::kMode}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.mode, MotionMode::kRate);
}

TEST(Keys, LetAStopWinOverAnEngageTypedWithIt) {
  for (const auto& order : {std::vector{KeyAction::kStop, KeyAction::kEngage},
                            std::vector{KeyAction::kEngage, KeyAction::kStop}}) {
    KeyboardState state;
    for (const KeyAction action : order) apply({action}, {}, MotionMode::kRate, state);
    EXPECT_TRUE(state.requests.stop);
    EXPECT_FALSE(state.requests.engage);
  }
}

TEST(Keys, CountScaleStepsAndToggleTheClutch) {
  KeyboardState state;
  for (const KeyAction action :
       {KeyAction::kScaleDown, KeyAction::kScaleDown, KeyAction::kScaleUp, KeyAction::kClutch}) {
    apply({action}, {}, MotionMode::kRate, state);
  }
  EXPECT_EQ(state.requests.scale_steps, -1);
  EXPECT_TRUE(state.requests.clutch);
  apply({KeyAction::kClutch}, {}, MotionMode::kRate, state);
  EXPECT_FALSE(state.requests.clutch);
}

TEST(Keys, CountKvSteps) {
  KeyboardState state;
  for (const KeyAction action : {KeyAction::kKvUp, KeyAction::kKvUp, KeyAction::kKvDown})
    apply({action}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.kv_steps, 1);
}

TEST(Keys, TurnTheGripperAndTwiceNothing) {
  KeyboardState state;
  apply({KeyAction::kGripper}, {}, MotionMode::kRate, state);
  EXPECT_TRUE(state.requests.turns_gripper);
  apply({KeyAction::kGripper}, {}, MotionMode::kRate, state);
  EXPECT_FALSE(state.requests.turns_gripper);
}

}  // namespace
}  // namespace longreach::keys_test
