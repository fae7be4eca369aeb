// The moment guard of the limiter, by the equations of slave/command/contact_guard.hpp, and through the node.

#include <gtest/gtest.h>

#include <cmath>

#include "slave/command/goal_limiter.hpp"
#include "tests/unit/slave/node_loop.hpp"

namespace longreach::moment_guard_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kGuard_nm = 5.0, kHold_nm = 2.5, kBleed_s = 0.2;
constexpr double kAcceleration = 2.0, kSpeed = 0.3;

const Vector3 kBack = -Vector3::UnitZ();  // in which the stop turns the tool

/// At rest, turned against a stop whose moment does not change.
struct TurnedAgainst {
  GoalLimiter limiter{CommandConfig{}, Vector3::Zero()};
  ContactForce moment{.in_contact = true, .reaction = kBack};
  LimiterOutput out{};
  bool let_go = false;

  explicit TurnedAgainst(double moment_nm) {
    moment.force_n = moment_nm;
    limiter.reset({});
  }
  Vector3 turn_to(double rad, int ticks = 300) {
    const Pose goal{Vector3::Zero(), exp_rotation(rad * Vector3::UnitZ())};
    for (int i = 0; i < ticks; ++i) out = limiter.step({goal, {}, kDt, let_go, moment});
    return limiter.velocity().angular;
  }
  Vector3 hold(int ticks = 300) {
    for (int i = 0; i < ticks; ++i) out = limiter.step({std::nullopt, {}, kDt, let_go, moment});
    return limiter.velocity().angular;
  }
  double turned_rad() const { return log_rotation(limiter.setpoint().q).z(); }
};

TEST(MomentGuard, BoundsTheSpeedIntoTheStopByWhatIsLeft) {
  for (const double moment_nm : {0.0, 2.0, 4.9, 5.0}) {
    TurnedAgainst t(moment_nm);
    const double left_rad = (kGuard_nm - moment_nm) / kGuardStiffness_nm_per_rad;
    EXPECT_NEAR(t.turn_to(2.0).z(), std::min(std::sqrt(2.0 * kAcceleration * left_rad), kSpeed), 1e-9)
        << moment_nm;
    EXPECT_TRUE(t.out.moment_guard);
    EXPECT_FALSE(t.out.force_guard);
    EXPECT_LT(t.turn_to(-2.0).z(), -0.25) << "the way back is free";
    EXPECT_FALSE(t.out.moment_guard);
  }
}

TEST(MomentGuard, ActsInAContactByRotationOnly) {
  TurnedAgainst t(50.0);
  t.moment.in_contact = false;
  EXPECT_NEAR(t.turn_to(2.0).z(), kSpeed, 1e-12);
}

TEST(MomentGuard, AboveItTheToolTurnsBackByTheStiffnessThatIsKnown) {
  for (const double stiffness : {0.0, 10.0, 100.0}) {
    TurnedAgainst t(kGuard_nm + 0.2);
    t.moment.stiffness_n_per_m = stiffness;
    const double k = stiffness > 0.0 ? stiffness : kGuardStiffness_nm_per_rad;
    EXPECT_NEAR(t.turn_to(0.1).z(), -0.2 / (k * kBleed_s), 1e-9) << stiffness;
  }
}

TEST(MomentGuard, WhatIsStillComingIsTakenBack) {
  TurnedAgainst t(kGuard_nm);
  t.moment.lead_m = 1e-3;
  EXPECT_NEAR(t.turn_to(0.1, 200).z(), -std::sqrt(2.0 * kAcceleration * 1e-3), 1e-9);
}

TEST(MomentGuard, AHoldComesDownToHalfOfItAndNoFurther) {
  TurnedAgainst t(kHold_nm + 0.5);
  EXPECT_LT(t.hold(100).z(), -1e-4);
  t.moment.force_n = 0.9 * kHold_nm;
  EXPECT_EQ(t.hold().z(), 0.0);
}

TEST(MomentGuard, WhileNobodyHoldsTheHandleItIsTheHoldLimit) {
  TurnedAgainst t(kHold_nm + 0.5);
  EXPECT_GT(t.turn_to(0.5, 50).z(), 0.0);
  t.let_go = true;
  EXPECT_LT(t.turn_to(0.5).z(), 0.0);
}

TEST(MomentGuard, RetreatsTenthRadianFromUnresponsiveMoment) {
  for (const bool holds : {false, true}) {
    TurnedAgainst t(kGuard_nm + 3.0);
    t.moment.stiffness_n_per_m = 5.0;
    if (holds)
      t.hold(5000);
    else
      t.turn_to(0.1, 5000);
    EXPECT_NEAR(t.turned_rad(), -0.1, 2e-3) << holds;
    EXPECT_TRUE(t.out.force_persists) << holds;
  }
}

TEST(MomentGuard, GivesWayToNothingThatIsNotTrusted) {
  TurnedAgainst t(kGuard_nm + 3.0);
  t.moment.trusted = false;
  t.turn_to(0.1);
  EXPECT_EQ(t.turned_rad(), 0.0);
  t.hold();
  EXPECT_EQ(t.turned_rad(), 0.0);
}

/// Turned at 0.2 rad/s to 0.5 rad into a stop, and the wall beside it.
struct NodeAtAStop {
  explicit NodeAtAStop(double guard_nm) : loop(config(guard_nm)) {
    loop.engage();
    loop.command.goal_kind = GoalKind::kGoalOrientation;
  }
  static SlaveConfig config(double guard_nm) {
    SlaveConfig c = test::wall_config(0.9, 1000.0);
    c.command.moment_guard_nm = guard_nm;
    c.scene.surface = {{"stop", "wall"}};
    c.scene.surface[0].hinge = HingeConfig{.angle_rad = 0.05, .arm_m = 0.2};  // 40 N m/rad
    return c;
  }
  void turn_to(double rad) {
    while (loop.command.rotation_rad.z() < rad) {
      loop.command.rotation_rad.z() += 2e-4;
      loop.tick();
    }
  }
  double moment_nm() const { return loop.arm.true_wrench().moment.norm(); }
  test::Loop loop;
};

TEST(MomentGuard, HoldsTheMomentOfAStopAndSaysSo) {
  NodeAtAStop guarded(5.0), unguarded(1000.0);
  for (NodeAtAStop* stop : {&guarded, &unguarded}) {
    stop->turn_to(0.5);
    stop->loop.run(3.0);
    EXPECT_TRUE(stop->loop.node.engaged());
    EXPECT_EQ(stop->loop.view().limit_violations, 0U);
  }
  EXPECT_NEAR(guarded.moment_nm(), 5.0, 0.15);
  EXPECT_TRUE(guarded.loop.view().clamps.moment_guard);
  EXPECT_GT(unguarded.moment_nm(), 15.0);
  EXPECT_FALSE(unguarded.loop.view().clamps.moment_guard);
  guarded.loop.silent = true;  // a hold
  guarded.loop.run(1.5);
  EXPECT_EQ(guarded.loop.view().state, SafetyState::kHolding);
  EXPECT_LE(guarded.moment_nm(), 2.55);
  EXPECT_GE(guarded.moment_nm(), 1.5) << "the contact is kept";
}

TEST(MomentGuard, AStoppedRobotStaysWhereItIs) {
  NodeAtAStop stop(5.0);
  stop.turn_to(0.5);
  stop.loop.run(1.0);
  stop.loop.command.request = Request::kStop;
  stop.loop.run(0.5);
  const double before_nm = stop.moment_nm();
  stop.loop.run(1.0);
  EXPECT_EQ(stop.loop.view().state, SafetyState::kStopped);
  EXPECT_NEAR(stop.moment_nm(), before_nm, 1e-6);
}

}  // namespace
}  // namespace longreach::moment_guard_test
