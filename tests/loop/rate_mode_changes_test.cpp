// What the operator changes in rate mode, in the whole loop: kv while the robot moves and while it presses, and rate mode
// that begins while the handle is away from home. Neither the goal nor the force steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/loop/clocks_bench.hpp"

namespace longreach::rate_mode_changes_test {
namespace {

constexpr double kForceStep_n = 0.3;  // between two ticks, for a hand that moves slowly

/// A firm hand on the handle, and what it sees from tick to tick.
class ChangingHand {
 public:
  explicit ChangingHand(const std::string& link, const std::vector<std::string>& more)
      : bench_(settings(link, more)) {
    hand_.grip = Grip::kFirm;
    lab().drive(hand_);
    clocks::run(lab(), 6.0);
    EXPECT_TRUE(clocks::engage(lab(), 10.0));
  }
  Laboratory& lab() { return *bench_.lab; }
  const MasterView& view() { return lab().master(); }
  [[nodiscard]] double tool_m() { return lab().arm().true_pose().p.x(); }

  void move_to(double x_m, double m_per_s, double rests_s) {
    const double from_m = hand_.position_m.x(), begin_s = lab().now_s(),
                 lasts_s = std::abs(x_m - from_m) / m_per_s;
    while (lab().now_s() < begin_s + lasts_s + rests_s) {
      const double share = lasts_s > 0.0 ? std::min(1.0, (lab().now_s() - begin_s) / lasts_s) : 1.0;
      hand_.position_m.x() = from_m + share * (x_m - from_m);
      lab().drive(hand_);
      tick();
    }
  }
  void change_kv(int steps) {
    lab().requests().kv_steps = steps;
    move_to(hand_.position_m.x(), 1.0, 1.5);
  }
  void forget_steps() { force_step_n = speed_step_m_per_s = 0.0; }

  double force_step_n = 0.0;        // largest change of the force on the hand in a tick
  double speed_step_m_per_s = 0.0;  // the same of the speed of the goal
  double speed_m_per_s = 0.0;       // of the goal along x

 private:
  static std::vector<std::string> settings(const std::string& link, const std::vector<std::string>& more) {
    std::vector<std::string> all{"profile=" + link, "scene.material.wall.stiffness_n_per_m=1000"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void tick() {
    const MasterView before = view();
    lab().step();
    const double now = (view().goal_m.x() - before.goal_m.x()) / lab().period_s();
    speed_step_m_per_s = std::max(speed_step_m_per_s, std::abs(now - speed_m_per_s));
    force_step_n = std::max(force_step_n, (view().F_H_M.force - before.F_H_M.force).norm());
    speed_m_per_s = now;
  }

  clocks::Bench bench_;
  HandTarget hand_{};
};

TEST(RateModeChanges, KvStepsNeitherSpeedNorForceInFreeMotion) {
  ChangingHand h("lab", {"mapping.mode=RATE", "scene.surface.wall.plane.point_m=0.9,0,0"});
  h.move_to(0.012, 0.02, 2.0);
  for (const int steps : {3, -6, 3}) {
    h.forget_steps();
    const double before = h.speed_m_per_s;
    h.change_kv(steps);
    const double change = std::abs(h.speed_m_per_s - before);
    EXPECT_NEAR(h.speed_m_per_s, std::pow(1.25, steps) * before, 0.02 * before);
    EXPECT_GT(change, 5e-3);
    EXPECT_LT(h.speed_step_m_per_s, 0.02 * change + 1e-4);  // 1e-4: an encoder count of the handle
    EXPECT_LT(h.force_step_n, 0.02);
  }
}

TEST(RateModeChanges, KvStepsNoForceWhileTheToolPresses) {
  for (const char* link : {"lab", "moon"}) {
    ChangingHand h(link, {"mapping.mode=RATE", "scene.surface.wall.plane.point_m=0.02,0,0"});
    h.move_to(0.015, 0.02, 15.0);
    const double felt_n = h.view().spring_force_n.norm(), tool_n = h.lab().arm().true_wrench().force.norm();
    ASSERT_GT(felt_n, 0.5) << link;
    h.forget_steps();
    h.change_kv(8);
    h.change_kv(-16);
    h.move_to(0.015, 1.0, 6.0);
    EXPECT_LT(h.force_step_n, 0.05) << link;
    EXPECT_NEAR(h.view().spring_force_n.norm(), felt_n, 0.1 * felt_n) << link;
    EXPECT_NEAR(h.lab().arm().true_wrench().force.norm(), tool_n, 0.1 * tool_n) << link;
  }
}

TEST(RateModeChanges, RateModeAwayFromHomeNeedsTheHandleHome) {
  for (const bool origin : {true, false}) {
    ChangingHand h("lab",
                   {"mapping.mode=POSITION", "scene.surface.wall.plane.point_m=0.9,0,0",
                    std::string("mapping.rate_centre=") + (origin ? "HANDLE_ORIGIN" : "WHERE_MODE_BEGAN")});
    h.move_to(0.03, 0.05, 2.0);
    const double rest_m = h.tool_m();
    h.lab().requests().mode = MotionMode::kRate;
    h.forget_steps();
    h.move_to(0.03, 1.0, 2.0);
    EXPECT_EQ(h.view().bring_home, origin);
    EXPECT_LT(h.force_step_n, kForceStep_n);
    EXPECT_LT(h.view().F_H_M.force.norm(), 0.5) << "a resting hand pays for no spring";
    for (int i = 0; i < 6; ++i) h.move_to(i % 2 == 0 ? 0.045 : 0.03, 0.05, 0.2);
    EXPECT_LT(h.force_step_n, kForceStep_n);
    EXPECT_GT(h.view().F_H_M.force.norm(), 0.0);
    EXPECT_GT(h.view().port_energy_min_j, -0.021) << "the initial store";
    if (!origin) {  // the control: without the rule, the robot moves
      EXPECT_GT(h.tool_m(), rest_m + 0.01);
      continue;
    }
    EXPECT_LT(std::abs(h.tool_m() - rest_m), 1e-4);
    EXPECT_TRUE(h.view().bring_home);
    h.move_to(0.0, 0.05, 1.0);
    EXPECT_FALSE(h.view().bring_home);
    EXPECT_LT(std::abs(h.tool_m() - rest_m), 1e-4);
    EXPECT_LT(h.force_step_n, kForceStep_n);
    h.move_to(0.015, 0.05, 1.0);
    EXPECT_GT(h.tool_m(), rest_m + 0.005);
    EXPECT_GT(h.view().port_energy_min_j, -0.021);
  }
}

}  // namespace
}  // namespace longreach::rate_mode_changes_test
