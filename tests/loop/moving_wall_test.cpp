// A wall that comes towards a robot whose operator holds still, over the whole loop: how far and how hard,
// and what the operator is told at the master.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "slave/config/guard_config.hpp"

namespace longreach::moving_wall_test {
namespace {

constexpr double kGuard_n = 20.0, kWall_n_per_m = 2000.0, kWall_m_per_s = 0.03, kGiveWay_m = 0.1;

struct Came {
  double force_n = 0.0;  // largest at the tool, engaged
  double way_m = 0.0;
  Reason reported{};  // first cause at the master
  bool engaged_again = false;
  double retreat_m = 0.0;  // then
};

/// `presses_on`: it is watched after the hold, too.
Came comes(double give_way_m, double watched_m, bool presses_on = false) {
  const proto::LabConfig config =
      configure({"profile=lab", "mapping.mode=POSITION", "mapping.scale=1", "safety.engage_at_start=true",
                 "command.give_way_m=" + std::to_string(give_way_m),
                 "scene.surface.wall.plane.point_m=" + std::to_string(3.0 * kWall_m_per_s) + ",0,0",
                 "scene.surface.wall.movement.velocity_m_per_s=" + std::to_string(-kWall_m_per_s) + ",0,0",
                 "scene.material.wall.stiffness_n_per_m=" + std::to_string(kWall_n_per_m)},
                LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  const double from_m = lab.arm().start_pose().p.x();
  Came out;
  const double until_s = 3.0 + (watched_m + kGuard_n / kWall_n_per_m) / kWall_m_per_s;
  while (lab.now_s() < until_s && (out.reported == HoldCause::kNone || presses_on)) {
    lab.drive({});
    lab.step();
    out.force_n = std::max(out.force_n, lab.arm().true_wrench().force.norm());
    out.way_m = from_m - lab.arm().true_pose().p.x();
    if (lab.master().state == SafetyState::kHolding) out.reported = lab.master().cause;
  }
  const double held_m = lab.arm().true_pose().p.x();
  lab.requests().engage = true;
  for (double t = 0.0; t < 1.0; t += lab.period_s()) {
    HandTarget hand;
    hand.position_m.x() = -0.1 * t;
    lab.drive(hand);
    lab.step();
    out.engaged_again = out.engaged_again || lab.slave().state == SafetyState::kEngaged;
  }
  out.retreat_m = held_m - lab.arm().true_pose().p.x();
  return out;
}

TEST(MovingWall, IsGivenWayToAndThenTheOperatorRetreats) {
  const Came came = comes(kGiveWay_m, 2.0 * kGiveWay_m);
  EXPECT_LE(came.force_n, kGuardOvershoot * kGuard_n);
  EXPECT_NEAR(came.way_m, kGiveWay_m, 2e-3);
  EXPECT_EQ(came.reported, HoldCause::kSurfaceApproaching);
  EXPECT_EQ(sentence(came.reported), "a surface is moving towards the robot; the direction of retreat is -x");
  EXPECT_TRUE(came.engaged_again);
  EXPECT_GT(came.retreat_m, 0.03);
}

/// Of skin, flesh and bone, while the hand goes to and fro by 15 mm: the first cause of a hold.
Reason layers_come(double m_per_s, double hand_m_per_s) {
  constexpr double kReach_m = 0.015;
  std::vector<std::string> settings{"profile=lab",
                                    "scene_file=scenes/layers.txtpb",
                                    "mapping.mode=POSITION",
                                    "mapping.scale=1",
                                    "safety.engage_at_start=true",
                                    "command.give_way_m=" + std::to_string(kGiveWay_m)};
  double deep_m = 3.0 * m_per_s;
  for (const char* layer : {"skin", "flesh", "bone"}) {
    const std::string surface = std::string("scene.surface.") + layer;
    settings.push_back(surface + ".plane.point_m=" + std::to_string(deep_m) + ",0,0");
    settings.push_back(surface + ".movement.velocity_m_per_s=" + std::to_string(-m_per_s) + ",0,0");
    deep_m += layer[0] == 's' ? 0.03 : 0.012;  // the bone is met at 0.8 of the guard
  }
  const proto::LabConfig config = configure(settings, LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  const double until_s = 3.0 + (2.0 * kGiveWay_m + 0.1) / m_per_s;
  while (lab.now_s() < until_s && (lab.now_s() < 2.0 || lab.slave().cause == HoldCause::kNone)) {
    HandTarget hand;
    const double way_m = std::fmod(hand_m_per_s * lab.now_s() + kReach_m, 4.0 * kReach_m);
    hand.position_m.x() = std::abs(way_m - 2.0 * kReach_m) - kReach_m;
    lab.drive(hand);
    lab.step();
  }
  return lab.slave().cause;
}

TEST(MovingWall, OfLayersIsNoWrongSignUnderAHandThatRestsOrMoves) {
  for (const double m_per_s : {0.01, 0.03}) {
    for (const double hand_m_per_s : {0.0, 5e-3, 0.02})
      EXPECT_EQ(layers_come(m_per_s, hand_m_per_s), HoldCause::kSurfaceApproaching)
          << m_per_s << ' ' << hand_m_per_s;
  }
}

TEST(MovingWall, WithoutThatWayItPressesOn) {
  EXPECT_GT(comes(0.02, kGiveWay_m, true).force_n, 2.0 * kGuard_n);
}

}  // namespace
}  // namespace longreach::moving_wall_test
