// From deflections and buttons to what the hand does.

#include "master/input/axis_hand.hpp"

#include <gtest/gtest.h>

namespace longreach::axis_hand_test {
namespace {

constexpr double kStep_s = 0.02;

AxisSample pushed(double x, double z = 0.0) { return {.present = true, .push = Vector3(x, 0, z)}; }
AxisSample pressing(PadButton button) {
  AxisSample s{.present = true};
  s.press(button, true);
  return s;
}

struct AxisHandTest : ::testing::Test {
  AxisHand hand{AxisHandConfig{}};
  /// With a new report each time, as while a hand holds it.
  AxisHandState step(AxisSample s, MotionMode mode = MotionMode::kRate) {
    s.reports = ++reports;
    return hand.step(s, mode, kStep_s);
  }
  /// How long a deflection moves the hand without a new report, s.
  double moves_s(AxisSample s, MotionMode mode = MotionMode::kRate) {
    AxisHandState now = step(s, mode);
    EXPECT_GT(now.level.target_m.x(), 0.0);
    s.reports = reports;
    int steps = 0;
    for (Vector3 before; steps < 500; ++steps) {
      before = now.level.target_m;
      now = hand.step(s, mode, kStep_s);
      if (now.silent && (mode == MotionMode::kRate ? Vector3(0, 0, 0) : before) == now.level.target_m) break;
    }
    EXPECT_GT(step(s, mode).level.target_m.x(), 0.0);  // a new report is a hand again
    return steps * kStep_s;
  }
  std::uint32_t reports = 0;
};

TEST_F(AxisHandTest, InRateModeTheDeflectionIsWhereTheHandIs) {
  step(pushed(0));
  EXPECT_EQ(step(pushed(0.1)).level.target_m, Vector3::Zero());  // within the dead zone
  EXPECT_NEAR(step(pushed(0.56)).level.target_m.x(), 0.5 * 0.04, 1e-12);
  EXPECT_NEAR(step(pushed(1)).level.target_m.x(), 0.04, 1e-12);
  EXPECT_NEAR(step(pushed(1, 1)).level.target_m.norm(), 0.04, 1e-12);  // no farther in a corner
  EXPECT_EQ(step(pushed(0)).level.target_m, Vector3::Zero());
}

TEST_F(AxisHandTest, InPositionModeTheDeflectionIsHowFastTheHandMoves) {
  step(pushed(0), MotionMode::kPosition);
  for (int i = 0; i < 50; ++i) step(pushed(1), MotionMode::kPosition);
  const Vector3 there = step(pushed(0), MotionMode::kPosition).level.target_m;
  EXPECT_NEAR(there.x(), 0.03, 1e-12);
  EXPECT_EQ(step(pushed(0), MotionMode::kPosition).level.target_m, there);  // let go, it stays
  for (int i = 0; i < 500; ++i) step(pushed(1), MotionMode::kPosition);
  EXPECT_NEAR(step(pushed(0), MotionMode::kPosition).level.target_m.x(), 0.075, 1e-12);  // the workspace
  EXPECT_EQ(step(pressing(PadButton::kHome), MotionMode::kPosition).level.target_m, Vector3::Zero());
}

TEST_F(AxisHandTest, TheTwistTurnsTheHand) {
  step({.present = true});
  const AxisSample s{.present = true, .twist = Vector3(0, 0, -1)};
  EXPECT_NEAR(step(s).level.target_rad.z(), -0.4, 1e-12);
}

TEST_F(AxisHandTest, WhatWasUnpluggedTakesUpWithoutAJump) {
  step(pushed(0), MotionMode::kPosition);
  for (int i = 0; i < 50; ++i) step(pushed(1), MotionMode::kPosition);
  const AxisHandState gone = step({}, MotionMode::kPosition);
  EXPECT_FALSE(gone.level.present);
  EXPECT_EQ(gone.level.target_m, Vector3::Zero());
  // Plugged in with a deflected stick and a button down: nothing, until both were let go of.
  AxisSample busy = pushed(1);
  busy.press(PadButton::kEngage, true);
  const AxisHandState back = step(busy);
  EXPECT_TRUE(back.level.present);
  EXPECT_FALSE(back.armed);
  EXPECT_FALSE(back.requests.engage);
  EXPECT_EQ(back.level.target_m, Vector3::Zero());
  EXPECT_TRUE(step({.present = true}).armed);
  EXPECT_GT(step(pushed(1)).level.target_m.x(), 0.0);
  EXPECT_TRUE(step(pressing(PadButton::kEngage)).requests.engage);
}

TEST_F(AxisHandTest, ButtonsActWhenTheyGoDownTheClutchWhileItIsDown) {
  step({.present = true});
  EXPECT_EQ(step(pressing(PadButton::kMode), MotionMode::kRate).requests.mode, MotionMode::kPosition);
  EXPECT_FALSE(step(pressing(PadButton::kMode), MotionMode::kRate).requests.mode);
  EXPECT_EQ(step(pressing(PadButton::kScaleUp)).requests.scale_steps, 1);
  EXPECT_EQ(step(pressing(PadButton::kScaleDown)).requests.scale_steps, -1);
  EXPECT_EQ(step(pressing(PadButton::kKvUp)).requests.kv_steps, 1);
  EXPECT_EQ(step(pressing(PadButton::kKvDown)).requests.kv_steps, -1);
  EXPECT_TRUE(step(pressing(PadButton::kGripper)).requests.turns_gripper);
  step({.present = true});
  EXPECT_TRUE(step(pressing(PadButton::kGripper)).requests.turns_gripper);
  EXPECT_TRUE(step(pressing(PadButton::kClutch)).level.clutch);
  EXPECT_TRUE(step(pressing(PadButton::kClutch)).level.clutch);
  EXPECT_FALSE(step({.present = true}).level.clutch);
  AxisSample all{.present = true, .buttons = 0xff};
  EXPECT_TRUE(step(all).requests.stop);
  step({.present = true});
  EXPECT_FALSE(step(all).requests.engage);  // a stop wins
}

TEST_F(AxisHandTest, AfterAChangeOfHandsItBeginsWhereTheHandleIs) {
  for (const MotionMode mode : {MotionMode::kRate, MotionMode::kPosition}) {
    step({.present = true}, mode);
    step(pushed(1), mode);
    const Vector3 handle_m(0.02, -0.01, 0.0), handle_rad(0.0, 0.0, 0.1);
    hand.begin_at(handle_m, handle_rad);
    const AxisHandState still_deflected = step(pushed(1), mode);
    EXPECT_EQ(still_deflected.level.target_m, handle_m);
    EXPECT_EQ(still_deflected.level.target_rad, handle_rad);
    step({.present = true}, mode);
    EXPECT_GT(step(pushed(1), mode).level.target_m.x(), handle_m.x() - 1e-12);
  }
}

TEST_F(AxisHandTest, ADeflectionWithoutNewReportsIsLetGo) {
  step({.present = true});
  for (const MotionMode mode : {MotionMode::kRate, MotionMode::kPosition}) {
    EXPECT_LE(moves_s(pushed(0.7), mode), 0.3 + kStep_s);
    EXPECT_LE(moves_s(pushed(1.0), mode), 1.0 + kStep_s);  // at its end stop a stick reads the same
  }
  OperatorConfig config;
  config.kind = OperatorKind::kSpacemouse;
  hand = AxisHand(axis_hand_config(config, DeviceConfig{}));
  step({.present = true});
  EXPECT_LE(moves_s(pushed(1.0)), 0.3 + kStep_s);  // a puck reports all the time
}

TEST_F(AxisHandTest, WhatIsNotFiniteIsNoDeflection) {
  step({.present = true});
  EXPECT_EQ(step(pushed(NAN)).level.target_m, Vector3::Zero());
  EXPECT_EQ(step(pushed(INFINITY)).level.target_m, Vector3::Zero());
  EXPECT_EQ(step({.present = true, .twist = Vector3(NAN, 1, 1)}).level.target_rad, Vector3::Zero());
}

}  // namespace
}  // namespace longreach::axis_hand_test
