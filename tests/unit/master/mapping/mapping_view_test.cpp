// What the master tells of the mapping: the forecast, the boundary of the handle, the load.

#include <gtest/gtest.h>

#include "master/master_node.hpp"

namespace longreach::mapping_view_test {
namespace {

struct Bench {
  Bench() {
    in.requests.engage = true;
    tick();
    report.message = {.engagement = node.view().engagement, .state = SafetyState::kEngaged};
    report.sequence = 1;
    in.reports = {&report, 1};
    tick();
    tick();
  }
  MasterOutput tick() {
    in.now += std::chrono::milliseconds(1);
    in.last_heard = in.now;
    const MasterOutput out = node.step(in);
    in.requests = {};
    in.reports = {};
    return out;
  }
  /// Moves the handle as fast as a hand may: 1 mm in each tick.
  void move_to(const Vector3& p_MH) {
    while (in.handle.p_MH != p_MH) {
      in.handle.p_MH += clamp_norm(p_MH - in.handle.p_MH, 1e-3);
      if ((p_MH - in.handle.p_MH).norm() < 1e-9) in.handle.p_MH = p_MH;
      tick();
    }
  }
  MasterNode node{MasterConfig{}};
  MasterInput in{};
  Received<StiffnessReport> report{};
};

TEST(MasterView, ForecastsTheGoalHalfARoundTripAhead) {
  Bench b;
  b.in.requests.mode = MotionMode::kRate;
  b.tick();
  b.in.rtt_s = 2.6;
  b.move_to({0.015, 0.0, 0.0});
  EXPECT_NEAR(b.node.view().forecast.p.x() - b.node.view().goal_m.x(), 1.3 * 2.0 * 0.010, 1e-12);
}

TEST(MasterView, SaysWhenAHandleIsToBeRelocated) {
  Bench b;
  const double radius_m = 0.93 * DeviceConfig{}.delta.workspace_m;
  b.move_to({0.0, 0.0, -0.99 * radius_m});
  EXPECT_FALSE(b.node.view().at_boundary);
  b.move_to({0.0, 0.0, -1.01 * radius_m});
  EXPECT_TRUE(b.node.view().at_boundary);
  b.in.requests.clutch = true;
  b.tick();
  EXPECT_FALSE(b.node.view().at_boundary) << "it is being relocated";
  b.move_to(Vector3::Zero());
  for (double rad = 0.0; rad < 0.76; rad += 0.02) {
    b.in.handle.q_MH = exp_rotation({0.0, rad, 0.0});
    b.tick();
  }
  b.in.handle.q_MH = exp_rotation({0.0, 0.76, 0.0});
  b.tick();
  b.tick();
  EXPECT_TRUE(b.node.view().at_boundary);
  b.in.requests.mode = MotionMode::kRate;
  b.tick();
  EXPECT_FALSE(b.node.view().at_boundary);
}

/// What the slave tells of its gripper, knowing what was sent until `knows`.
Received<StiffnessReport> reported(const Bench& b, bool closed, bool holds, Time knows) {
  Received<StiffnessReport> r;
  r.received = b.in.now;
  r.echo_sent = knows;
  r.message.engagement = b.node.view().engagement;
  r.message.state = SafetyState::kEngaged;
  r.message.gripper_closed = closed;
  r.message.load = holds;
  return r;
}

std::optional<bool> sent(Bench& b) {
  for (int i = 0; i < 20; ++i) {
    if (const auto command = b.tick().command) return command->grip;
  }
  ADD_FAILURE() << "no command";
  return {};
}

TEST(MasterView, TheGripperIsAsItIsUntilSomebodyAsksForAnother) {
  Bench b;
  EXPECT_EQ(sent(b), std::nullopt);
  Received<StiffnessReport> r = reported(b, true, true, b.in.now);
  b.in.reports = {&r, 1};
  b.tick();
  b.in.reports = {};
  EXPECT_TRUE(b.node.view().gripper_closed) << "as a master before has left it";
  EXPECT_EQ(sent(b), std::nullopt);
  b.in.requests.turns_gripper = true;
  b.tick();
  b.in.requests = {};
  EXPECT_FALSE(b.node.view().gripper_closed);
  EXPECT_EQ(sent(b), false);
}

TEST(MasterView, SendsGripperRequestUntilSlaveHasDoneIt) {
  Bench b;
  const Time before = b.in.now;
  b.in.requests.grip = true;
  b.tick();
  b.in.requests = {};
  b.in.requests.turns_gripper = true;
  b.tick();
  b.in.requests = {};
  EXPECT_EQ(sent(b), false) << "closed and open again, before the slave has heard of either";
  for (const auto& [closed, knows, goes_on] :
       {std::tuple{false, before, true}, {true, b.in.now, true}, {false, b.in.now, false}}) {
    Received<StiffnessReport> r = reported(b, closed, false, knows);
    b.in.reports = {&r, 1};
    b.tick();
    b.in.reports = {};
    EXPECT_EQ(sent(b).has_value(), goes_on) << closed;
  }
}

TEST(MasterView, AnotherMastersGripperIsNotAskedForAgain) {
  Bench b;
  b.in.requests.grip = true;
  b.tick();
  b.in.requests = {};
  b.in.taken = true;
  b.tick();
  b.in.taken = false;
  EXPECT_EQ(sent(b), std::nullopt);
}

/// Returns the speed of the goal in rate mode with the handle deflected by 50 mm, m/s.
double rate_speed(Bench& b) {
  b.move_to({0.05, 0.0, 0.0});
  const double before_m = b.node.view().goal_m.x();
  b.tick();
  return 1e3 * (b.node.view().goal_m.x() - before_m);
}

TEST(MasterView, TheGoalIsNotFasterThanTheRobotInUnknownSpace) {
  Bench b;
  b.in.requests.mode = MotionMode::kRate;
  b.tick();
  const double free_m_per_s = rate_speed(b);
  EXPECT_GT(free_m_per_s, 0.08);
  b.report.message.approach_m_per_s = 0.05;
  b.in.reports = {&b.report, 1};
  b.tick();
  EXPECT_NEAR(rate_speed(b), 0.05, 1e-9);
  b.report.message.approach_m_per_s = 0.0;
  b.in.reports = {&b.report, 1};
  b.tick();
  EXPECT_NEAR(rate_speed(b), free_m_per_s, 1e-9);
}

// In rate mode over a delay, the goal must not run ahead of a robot that enters unknown space.
TEST(MasterView, InRateModeTheGoalRunsAheadByTwoCentimetresAtMost) {
  Bench b;
  b.report.message.approach_m_per_s = 0.05;
  b.in.reports = {&b.report, 1};
  b.tick();
  b.report.message.approach_m_per_s = 0.0;
  b.in.reports = {&b.report, 1};
  b.in.requests.mode = MotionMode::kRate;
  b.in.rtt_s = 2.0;
  b.tick();
  EXPECT_NEAR(rate_speed(b), 0.05 + 0.02 / 2.0, 1e-9);
}

// A gripper that closed on nothing is closed, and holds nothing.
TEST(MasterView, ALoadIsFeltInRateMode) {
  double force_n[2];
  for (const bool load : {false, true}) {
    Bench b;
    Received<StiffnessReport> r = reported(b, true, load, b.in.now);
    b.in.reports = {&r, 1};
    b.tick();
    b.in.reports = {};
    b.in.requests.mode = MotionMode::kRate;
    for (int i = 0; i < 4000; ++i) b.tick();  // the friction of position mode fades
    b.move_to({0.02, 0.0, 0.0});
    for (int i = 0; i < 200; ++i) b.tick();  // until it rests there
    force_n[load] = -b.tick().F_H_M.force.x();
  }
  EXPECT_NEAR(force_n[1] / force_n[0], RenderingConfig{}.load_factor, 1e-6);
}

}  // namespace
}  // namespace longreach::mapping_view_test
