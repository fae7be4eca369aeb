// When a free body counts as docked: grasped, at its goal, pressed until the force vanished, released and left.

#include "deploy/cli/task/dock_progress.hpp"

#include <gtest/gtest.h>

namespace longreach::dock_progress_test {
namespace {

const Vector3 kStart{0.4, -0.1, 0.3}, kGoal{0.5, 0.2, 0.0}, kPin{-0.3, 0.0, 0.0};

BodyGoalConfig goal(double needed_n = 8.0) {
  BodyGoalConfig config;
  config.position_m = kGoal;
  config.within_m = 0.02;
  config.within_rad = 0.1;
  config.force_n = needed_n;
  return config;
}

/// The tool holds the body by its pin, or has left it.
class Docking {
 public:
  explicit Docking(double needed_n = 8.0) : progress(goal(needed_n), kStart) { step(); }

  void step() {
    if (holds) body_m = tool_m - kPin;
    progress.step({.t_s = t_s_ += 0.1,
                   .tool_m = kStart + tool_m,
                   .X_WB = Pose{kStart + body_m, exp_rotation(turned_rad)},
                   .holds = holds,
                   .force_n = force_n});
  }
  void to(const Vector3& p_m) {
    tool_m = p_m;
    step();
  }
  void grasp() {
    to(body_m + kPin);
    holds = true;
    step();
  }
  void press(double n) {
    force_n = n;
    step();
  }
  void dock() {
    grasp();
    to(kGoal + kPin);
    press(12.0);
    press(0.5);
  }

  DockProgress progress;
  Vector3 tool_m = Vector3::Zero(), body_m{0.5, 0.0, 0.0}, turned_rad = Vector3::Zero();
  bool holds = false;
  double force_n = 0.0;

 private:
  double t_s_ = 50.0;
};

TEST(DockProgress, ADockedBodyIsLeftAtItsGoal) {
  Docking d;
  EXPECT_EQ(d.progress.phase(), DockPhase::kWaiting);
  d.to({0.01, 0, 0});
  EXPECT_EQ(d.progress.phase(), DockPhase::kBegun);
  EXPECT_EQ(d.progress.figures().time_s, 0.0) << "begins here";
  d.grasp();
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld);
  EXPECT_NEAR(d.progress.figures().grasp_s, 0.2, 1e-9);
  d.to(kGoal + kPin + Vector3(0.003, 0, 0));
  d.press(12.0);
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld) << "while it presses";
  d.press(0.5);
  EXPECT_EQ(d.progress.phase(), DockPhase::kSeated);
  EXPECT_EQ(d.progress.figures().seat_force_n, 12.0);
  d.holds = false;
  d.step();
  EXPECT_EQ(d.progress.phase(), DockPhase::kReleased);
  d.to(d.tool_m - Vector3(0.02, 0, 0));
  EXPECT_EQ(d.progress.phase(), DockPhase::kReleased) << "not far enough";
  d.to(d.tool_m + Vector3(0.06, 0, 0));
  EXPECT_EQ(d.progress.phase(), DockPhase::kReleased) << "towards the body";
  d.to(d.tool_m - Vector3(0.08, 0, 0));
  EXPECT_EQ(d.progress.phase(), DockPhase::kDone);
  EXPECT_NEAR(d.progress.figures().time_s, 0.9, 1e-9);
  EXPECT_NEAR(d.progress.figures().position_error_m, 0.003, 1e-9);
  d.body_m.setZero();
  d.step();
  EXPECT_NEAR(d.progress.figures().position_error_m, 0.003, 1e-9) << "of the end";
}

TEST(DockProgress, WithoutTheForceABodyIsNotSeated) {
  for (const double n : {0.0, 7.9}) {
    Docking d;
    d.grasp();
    d.to(kGoal + kPin);
    d.press(n);
    d.press(0.0);
    EXPECT_EQ(d.progress.phase(), DockPhase::kHeld) << n;
    d.holds = false;
    d.step();
    d.to({0, 0, 0});
    EXPECT_EQ(d.progress.phase(), DockPhase::kBegun) << n;
  }
  Docking needs_none(0.0);
  needs_none.grasp();
  needs_none.press(3.0);
  needs_none.to(kGoal + kPin);
  EXPECT_EQ(needs_none.progress.phase(), DockPhase::kSeated);
}

TEST(DockProgress, AForceElsewhereDoesNotCount) {
  Docking d;
  d.grasp();
  d.to(kGoal + kPin - Vector3(0.05, 0, 0));
  d.press(15.0);
  d.press(0.0);
  d.to(kGoal + kPin);
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld);
}

TEST(DockProgress, ATurnedBodyIsNotAtItsGoal) {
  Docking d;
  d.turned_rad = {0, 0, 0.11};
  d.dock();
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld);
  EXPECT_NEAR(d.progress.figures().angle_error_rad, 0.11, 1e-9);
}

TEST(DockProgress, ABodyThatLeavesItsGoalMustPressAgain) {
  Docking d;
  d.dock();
  d.to(d.tool_m - Vector3(0.05, 0, 0));
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld) << "it was not latched";
  d.to(kGoal + kPin);
  EXPECT_EQ(d.progress.phase(), DockPhase::kHeld);
  d.press(12.0);
  d.press(0.0);
  d.holds = false;
  d.step();
  d.body_m.x() -= 0.03;  // it drifts away
  d.to({0, 0, 0});
  EXPECT_EQ(d.progress.phase(), DockPhase::kBegun);
}

TEST(DockProgress, AnUnknownBodyIsNotJudged) {
  DockProgress progress(goal(), kStart);
  progress.step({.t_s = 1.0, .tool_m = kStart, .X_WB = {}, .holds = true, .force_n = 9.0});
  progress.step({.t_s = 2.0, .tool_m = kStart + kGoal, .X_WB = {}, .holds = true, .force_n = 0.0});
  EXPECT_FALSE(progress.body_known());
  EXPECT_EQ(progress.phase(), DockPhase::kBegun);
}

TEST(DockProgress, ASceneWithoutAGoalHasNone) { EXPECT_FALSE(dock_of({}, {}).has_value()); }

}  // namespace
}  // namespace longreach::dock_progress_test
