#include "slave/slave_node.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/link/protection.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "tests/support/allocations.hpp"
#include "tests/unit/slave/node_loop.hpp"

namespace longreach::slave_node_test {
namespace {

using std::chrono::milliseconds;
using test::Loop;

TEST(SlaveNode, EngagesByHandshakeWithoutAJump) {
  Loop loop(test::wall_config(0.22, 1000.0));
  loop.echo = false;
  loop.command.engagement = 1;
  loop.command.request = Request::kEngage;
  loop.run(0.5);
  EXPECT_EQ(loop.view().state, SafetyState::kObserving);
  loop.echo = true;
  loop.run(0.5);
  EXPECT_TRUE(loop.node.engaged());
  EXPECT_EQ(loop.last_report->engagement, 1U);
  EXPECT_EQ(loop.last_report->state, SafetyState::kEngaged);
  EXPECT_LT((loop.arm.true_pose().p - loop.arm.start_pose().p).norm(), 1e-9);
  // Engaging anew somewhere else does not move it either.
  loop.move_to(0.05, 0.05);
  loop.run(1.0);
  const Vector3 before = loop.arm.true_pose().p;
  loop.command.engagement = 2;
  loop.command.position_m.setZero();
  loop.run(1.0);
  EXPECT_EQ(loop.view().engagement, 2U);
  EXPECT_LT((loop.arm.true_pose().p - before).norm(), 1e-9);
  EXPECT_EQ(loop.view().limit_violations, 0U);
}

TEST(SlaveNode, FollowsPositionAndOrientationFromTheAnchor) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  loop.command.position_m = Vector3(0.1, -0.2, 0.15);
  loop.run(0.3);
  loop.command.goal_kind = GoalKind::kGoalOrientation;
  loop.command.position_m = Vector3(9, 9, 9);  // not carried by this kind
  loop.command.rotation_rad = Vector3(0.1, 0.2, -0.1);
  loop.run(4.0);
  const Pose start = loop.arm.start_pose();
  EXPECT_LT((loop.arm.true_pose().p - start.p - Vector3(0.1, -0.2, 0.15)).norm(), 1e-6);
  const Quaternion q = exp_rotation(Vector3(0.1, 0.2, -0.1)) * start.q;
  EXPECT_LT(loop.arm.true_pose().q.angularDistance(q), 1e-6);
  EXPECT_EQ(loop.view().limit_violations, 0U)
      << name_of(loop.view().violations_by_limit.first) << loop.view().violations_by_limit.joint;
  EXPECT_EQ(loop.view().ik_failures, 0U);
}

TEST(SlaveNode, TouchesTheWallReportsItsStiffnessAndWhereItWasMet) {
  for (const double stiffness : {1000.0, 5000.0}) {
    Loop loop(test::wall_config(0.05, stiffness));
    loop.engage();
    loop.move_to(0.047, 0.05);
    loop.run(0.5);
    EXPECT_EQ(loop.view().touch, 0U);
    const std::uint64_t reached = loop.last_report->reached_sequence;
    EXPECT_GT(reached, 0U);
    loop.move_to(0.05 + 2.0 / stiffness, 0.002);
    for (int i = 0; i < 8000; ++i) {
      loop.command.position_m.x() += 1.5e-4 * std::cos(2 * test::kPi * 0.25 * i * 1e-3) * 1e-3;
      loop.tick();
    }
    const SlaveView& view = loop.view();
    ASSERT_TRUE(view.in_contact);
    EXPECT_EQ(view.touch, 1U);
    EXPECT_NEAR(view.reported_stiffness_n_per_m / loop.arm.material_stiffness(view.reported_at_m), 1.0, 0.03);
    const ReportedSurface& surface = loop.last_report->translation.surfaces[0];
    EXPECT_TRUE(surface.pressed);
    EXPECT_EQ(surface.touch, 1U);
    EXPECT_EQ(surface.stiffness, view.reported_stiffness_n_per_m);
    EXPECT_LT((surface.normal + Vector3::UnitX()).norm(), 0.02);
    // The goal of the touch command is the wall, though the tool came later.
    const double touch = surface.touch_sequence;
    const auto whole = static_cast<std::size_t>(touch);
    ASSERT_GT(whole, 0U);
    const double part = touch - static_cast<double>(whole);
    const double goal = loop.goals_x[whole] + part * (loop.goals_x[whole + 1] - loop.goals_x[whole]);
    EXPECT_NEAR(goal, 0.05, 1e-4);
    EXPECT_TRUE(loop.last_report->translation.held_back.isZero(0.0));
    // After a retreat it is remembered.
    loop.move_to(0.045, 0.01);
    loop.run(0.5);
    EXPECT_FALSE(loop.last_report->translation.in_contact());
    EXPECT_EQ(loop.last_report->translation.surfaces[0].stiffness, view.reported_stiffness_n_per_m);
    EXPECT_EQ(view.limit_violations, 0U);
  }
}

TEST(SlaveNode, ALaterDipOfTheGoalDoesNotMoveTheTouch) {
  Loop loop(test::wall_config(0.05, 1000.0));
  loop.engage();
  loop.move_to(0.052, 0.005);
  loop.run(1.0);
  const double touch = loop.last_report->translation.surfaces[0].touch_sequence;
  ASSERT_GT(touch, 0.0);
  loop.command.position_m.x() = 0.0495;  // in front of the wall for one command: too short for the tool
  loop.run(0.005);
  loop.command.position_m.x() = 0.052;
  loop.run(1.0);
  EXPECT_EQ(loop.view().touch, 1U);
  EXPECT_NEAR(loop.last_report->translation.surfaces[0].touch_sequence, touch, 5.0);
}

TEST(SlaveNode, HoldsOnSilenceWithinGapAndBraking) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  loop.move_to(0.2, 0.2);
  loop.command.position_m.x() = 0.8;
  loop.run(1.0);
  const double before = loop.travelled();
  loop.silent = true;
  loop.run(0.16);
  EXPECT_EQ(loop.view().state, SafetyState::kHolding);
  EXPECT_EQ(loop.view().cause, HoldCause::kLinkSilent);
  EXPECT_EQ(loop.last_report->state, SafetyState::kHolding);  // reported at once
  loop.run(0.5);
  const double v = 0.25;
  EXPECT_LT(loop.travelled() - before, v * (0.16 + 1.0 / 62.8) + v * v / (2 * 1.25) + 1e-3);
  const double stopped = loop.travelled();
  loop.run(1.0);
  EXPECT_NEAR(loop.travelled(), stopped, 1e-6);
  EXPECT_EQ(loop.view().limit_violations, 0U);
  // Too long: it does not resume by itself.
  loop.silent = false;
  loop.run(1.0);
  EXPECT_NEAR(loop.travelled(), stopped, 1e-6);
  EXPECT_EQ(loop.view().state, SafetyState::kHolding);
}

TEST(SlaveNode, ResumesAShortSilenceWithinTheLimits) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  loop.command.position_m.x() = 0.5;
  loop.run(0.5);
  loop.silent = true;
  loop.run(0.5);
  EXPECT_EQ(loop.view().state, SafetyState::kHolding);
  loop.silent = false;
  loop.run(8.0);
  EXPECT_TRUE(loop.node.engaged());
  EXPECT_EQ(loop.view().false_holds, 1U);
  EXPECT_NEAR(loop.travelled(), 0.5, 1e-6);
  EXPECT_EQ(loop.view().limit_violations, 0U);
}

TEST(SlaveNode, AFastTouchKeepsTheForceGuard) {
  Loop loop(test::wall_config(0.1, 5000.0));
  loop.engage();
  loop.move_to(0.2, 0.05);
  loop.run(2.0);
  EXPECT_LT(-loop.arm.true_wrench().force.x(), 1.35 * 20.0);
  EXPECT_GT(-loop.arm.true_wrench().force.x(), 15.0);
  EXPECT_TRUE(loop.view().clamps.force_guard);
}

TEST(SlaveNode, NonFiniteRobotStateIsFaultAndKeepsSetpoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int what = 0; what < 3; ++what) {
    Loop loop(test::wall_config(0.9, 1000.0));
    loop.engage();
    loop.move_to(0.05, 0.05);
    loop.broken.joint_rad = test::start_joints();
    if (what == 0) loop.broken.joint_rad[3] = nan;
    if (what == 1) loop.broken.F_F_W.force.x() = std::numeric_limits<double>::infinity();
    if (what == 2) loop.broken.ok = false;
    loop.use_broken = true;
    loop.run(0.5);
    EXPECT_EQ(loop.view().state, SafetyState::kFault) << what;
    EXPECT_EQ(loop.view().cause, what == 1 ? HoldCause::kSensorFault : HoldCause::kRobotFault);
    EXPECT_TRUE(loop.view().X_WE.p.allFinite());
    const double stopped = loop.travelled();
    loop.use_broken = false;
    loop.run(0.5);
    EXPECT_EQ(loop.view().state, SafetyState::kFault) << what;
    EXPECT_NEAR(loop.travelled(), stopped, 1e-6);
    EXPECT_EQ(loop.view().limit_violations, 0U);
  }
}

TEST(SlaveNode, SurvivesAFirstStateThatIsNotFinite) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.broken.joint_rad.setConstant(std::numeric_limits<double>::quiet_NaN());
  loop.use_broken = true;
  loop.run(0.1);
  EXPECT_EQ(loop.view().state, SafetyState::kFault);
}

TEST(SlaveNode, IgnoresImpossibleGoalsButNotAStop) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  loop.command.position_m = Vector3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  loop.run(0.1);
  EXPECT_GT(loop.view().rejected_values, 0U);
  EXPECT_NEAR(loop.travelled(), 0.0, 1e-9);
  loop.command.request = Request::kStop;
  loop.run(0.01);
  EXPECT_EQ(loop.view().state, SafetyState::kStopped);
}

// Goals come 300 times a second, the setpoint is made 1000 times: its path is made of steps.
TEST(SlaveNode, AtAFewPerCentOfItsSpeedLimitItIsNotAtItsSpeedLimit) {
  SlaveConfig config = test::wall_config(5.0, 1000.0);
  Loop loop(config);
  loop.engage();
  const double speed_m_per_s = 0.04 * config.command.speed_max_m_per_s;
  int fast = 0, hasty = 0;
  for (int i = 0; i < 4000; ++i) {
    if (i % 3 == 0) loop.command.position_m.x() = 1e-3 * i * speed_m_per_s;
    loop.tick();
    fast += loop.view().clamps.tool_speed || loop.view().clamps.joint_speed;
    hasty += loop.view().clamps.acceleration;
  }
  std::printf("at a speed limit in %d of 4000 ticks, at that of acceleration in %d\n", fast, hasty);
  EXPECT_EQ(fast, 0);
  loop.command.position_m.x() += 1.0;
  loop.run(1.0);
  EXPECT_TRUE(loop.view().clamps.tool_speed);
}

TEST(SlaveNode, KeepsWithinReachAndSaysSo) {
  SlaveConfig config = test::wall_config(50.0, 1000.0);
  config.command.workspace_m = 20.0;
  config.command.speed_max_m_per_s = 1.0;
  config.command.force_guard_n = 1000.0;  // permits this speed in unknown space
  Loop loop(config);
  loop.engage();
  loop.command.position_m = Vector3(8.0, 0, 0);  // beyond the stretched arm
  Clamps seen;
  for (int i = 0; i < 20000; ++i) {
    loop.tick();
    seen.singularity = seen.singularity || loop.view().clamps.singularity;
    seen.unreachable = seen.unreachable || loop.view().clamps.unreachable;
    seen.joint_speed = seen.joint_speed || loop.view().clamps.joint_speed;
  }
  EXPECT_TRUE(seen.singularity);
  EXPECT_TRUE(seen.unreachable);
  EXPECT_TRUE(seen.joint_speed) << "the joints are slower than the tool may be";
  EXPECT_GT(loop.travelled(), 3.0);
  // And comes back.
  loop.command.position_m = Vector3(0, 0, 0);
  loop.run(40.0);
  EXPECT_NEAR(loop.travelled(), 0.0, 1e-6);
}

TEST(SlaveNode, AFreeSceneHasNoContact) {
  SlaveConfig config = test::wall_config(0.9, 1000.0);
  config.scene = {};
  Loop loop(config);
  loop.engage();
  loop.move_to(0.1, 0.1);
  loop.run(1.0);
  EXPECT_NEAR(loop.travelled(), 0.1, 1e-6);
  EXPECT_EQ(loop.view().touch, 0U);
  EXPECT_GT(loop.last_report->reached_sequence, 0U);
}

// The scene is the simulator's: a force that it does not contain is a contact all the same, and is guarded.
TEST(SlaveNode, AForceIsAContactWhateverTheScene) {
  SlaveConfig config = test::wall_config(0.9, 1000.0);
  config.scene = {};
  Loop loop(config);
  loop.sensor_fault = [&](RobotState& reported) {
    reported.F_F_W.force.x() -= 5000.0 * std::max(loop.travelled() - 0.05, 0.0);
  };
  loop.engage();
  loop.move_to(0.1, 0.05);
  loop.run(1.0);
  EXPECT_TRUE(loop.view().in_contact);
  EXPECT_TRUE(loop.view().clamps.force_guard);
  EXPECT_LT(5000.0 * (loop.travelled() - 0.05), 1.05 * 20.0);
  EXPECT_EQ(loop.view().reduced, 0U);
}

TEST(SlaveNode, AMomentIsGuardedWhateverTheScene) {
  SlaveConfig config = test::wall_config(0.9, 1000.0);
  config.scene = {};
  Loop loop(config);
  loop.engage();
  loop.run(0.5);
  EXPECT_FALSE(loop.view().in_contact);
  loop.sensor_fault = [](RobotState& reported) { reported.F_F_W.moment.z() -= 4.0; };
  loop.run(0.5);
  EXPECT_TRUE(loop.view().in_contact);
  EXPECT_FALSE(loop.view().clamps.moment_guard);
  loop.sensor_fault = [](RobotState& reported) { reported.F_F_W.moment.z() -= 6.0; };
  loop.command.goal_kind = GoalKind::kGoalOrientation;
  loop.command.rotation_rad = Vector3(0.0, 0.0, 0.1);
  loop.run(0.2);
  EXPECT_TRUE(loop.view().clamps.moment_guard);
}

// The bias is there from the start, with a bias of the force, and is zeroed in free motion.
TEST(SlaveNode, ABiasOfTheMomentIsNoContactAndHidesNone) {
  SlaveConfig config = test::wall_config(0.9, 1000.0);
  Loop loop(config);
  double contact_nm = 0.0;
  loop.sensor_fault = [&contact_nm](RobotState& reported) {
    reported.F_F_W.force += Vector3(2.0, -1.0, 3.0);
    reported.F_F_W.moment += Vector3(0.5 + contact_nm, 0.3, -0.4);
  };
  loop.engage();
  for (const double x_m : {0.03, 0.0, 0.03}) {
    loop.move_to(x_m, 0.05);
    loop.run(1.0);
    EXPECT_FALSE(loop.view().in_contact) << x_m;
  }
  contact_nm = 0.1;
  loop.run(0.2);
  EXPECT_TRUE(loop.view().in_contact);
}

TEST(SlaveNode, WithoutAForceSensorItSaysThatThereIsNoForceGuard) {
  for (const bool force : {true, false}) {
    SlaveConfig config = test::wall_config(0.02, 1000.0);
    config.sensing.force = force;
    Loop loop(config);
    loop.engage();
    loop.move_to(0.03, 0.03);
    loop.run(0.5);
    EXPECT_EQ(loop.view().in_contact, force);
    const std::uint32_t none = with(with(0, Protection::kForceGuard, true), Protection::kMomentGuard, true);
    EXPECT_EQ(loop.view().reduced, force ? 0U : none);
  }
}

TEST(SlaveNode, MovesSlowlyOnlyWhereTheToolHasNotBeen) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  double slow = 0.0;  // the limit, which depends on the pose
  const auto fastest = [&](double x) {
    loop.command.position_m.x() = x;
    double most = 0.0, before = loop.travelled();
    slow = 0.0;
    for (int i = 0; i < 6000 && std::abs(loop.travelled() - x) > 1e-4; ++i) {
      loop.tick();
      slow = std::max(slow, loop.view().approach_m_per_s);
      most = std::max(most, std::abs(loop.travelled() - std::exchange(before, loop.travelled())) * 1e3);
    }
    return most;
  };
  loop.run(0.1);
  EXPECT_EQ(loop.last_report->approach_m_per_s, loop.view().approach_m_per_s);
  const double there = fastest(0.3);
  EXPECT_GT(slow, 0.05);
  EXPECT_LT(slow, 0.12);
  EXPECT_LE(there, 1.01 * slow);
  EXPECT_GE(there, 0.8 * slow);
  EXPECT_NEAR(fastest(0.0), 0.25, 0.01);
  EXPECT_EQ(loop.view().limit_violations, 0U);
  loop.engage(2);
  EXPECT_LE(fastest(0.3), 1.01 * slow) << "a new engagement forgets";
}

TEST(SlaveNode, StepAllocatesNothing) {
  Loop loop(test::wall_config(0.05, 1000.0));
  loop.engage();
  loop.goals_x.reserve(100000);
  test::count_allocations(true);
  loop.move_to(0.055, 0.01);
  loop.run(1.0);
  loop.silent = true;
  loop.run(1.5);
  loop.silent = false;
  loop.run(0.5);
  test::count_allocations(false);
  EXPECT_EQ(loop.view().touch, 1U);
  EXPECT_EQ(test::allocations(), 0);
}

}  // namespace
}  // namespace longreach::slave_node_test
