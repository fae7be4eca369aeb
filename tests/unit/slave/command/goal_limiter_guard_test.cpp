// The force guard of the limiter, law by law: speeds by the equations of slave/command/goal_limiter.hpp.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slave/command/goal_limiter.hpp"
#include "slave/command/vector_limit.hpp"

namespace longreach::goal_limiter_guard_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kGuard_n = 20.0, kHold_n = 10.0, kStiffest_n_per_m = 2e4, kBleed_s = 0.2;
constexpr double kAcceleration = 1.25, kSpeed = 0.25;

const Vector3 kOut = -Vector3::UnitX();  // of the contact

/// At rest at zero, then in a contact that does not change.
struct Touching {
  GoalLimiter limiter{CommandConfig{}, Vector3::Zero()};
  ContactForce contact{.in_contact = true, .reaction = kOut};
  LimiterOutput out{};

  explicit Touching(double force_n) {
    contact.force_n = force_n;
    limiter.reset({});
  }
  bool let_go = false;

  Vector3 go_to(const Vector3& goal_m, int ticks = 300) {
    for (int i = 0; i < ticks; ++i)
      out = limiter.step({Pose{goal_m, Quaternion::Identity()}, contact, kDt, let_go});
    return limiter.velocity().linear;
  }
  Vector3 hold(int ticks = 300) {
    for (int i = 0; i < ticks; ++i) out = limiter.step({std::nullopt, contact, kDt});
    return limiter.velocity().linear;
  }
};

TEST(GoalLimiterGuard, BoundsSpeedWhereForceGrows) {
  for (const double force_n : {0.0, 15.0, 19.9, 20.0, 25.0}) {
    for (const double lead_m : {-1e-3, 0.0, 1e-4}) {
      Touching t(force_n);
      t.contact.grows = Vector3::UnitY();
      t.contact.grows_lead_m = lead_m;
      const double left_m = (kGuard_n - force_n) / kStiffest_n_per_m - std::max(lead_m, 0.0);
      const double allowed = std::min(std::sqrt(2.0 * kAcceleration * std::max(left_m, 0.0)), kSpeed);
      EXPECT_NEAR(t.go_to(Vector3(0, 2, 0)).y(), allowed, 1e-12) << force_n << ' ' << lead_m;
      EXPECT_TRUE(t.out.force_guard);
      EXPECT_LT(t.go_to(Vector3(0, -2, 0)).y(), -0.2) << "the way back is free";
      EXPECT_EQ(t.out.force_guard, force_n > kGuard_n) << "but for what is above the guard";
    }
  }
}

TEST(GoalLimiterGuard, AForceThatIsNoLongerWhereItWasBoundsTheSpeedAgainstIt) {
  for (const double force_n : {5.0, 19.9, 20.0, 45.0}) {
    Touching t(-3.0);
    t.contact.elsewhere = -Vector3::UnitY();
    t.contact.elsewhere_n = force_n;
    const double left_m = std::max(kGuard_n - force_n, 0.0) / kStiffest_n_per_m;
    EXPECT_NEAR(t.go_to(Vector3(0, 2, 0)).y(), std::min(std::sqrt(2.0 * kAcceleration * left_m), kSpeed),
                1e-12)
        << force_n;
    EXPECT_LT(t.go_to(Vector3(0, -2, 0)).y(), -0.2) << "the way back is free";
  }
}

TEST(GoalLimiterGuard, WhereTheForceGrowsMattersInContactOnly) {
  Touching t(15.0);
  t.contact.grows = Vector3::UnitY();
  t.contact.in_contact = false;
  EXPECT_NEAR(t.go_to(Vector3(0, 2, 0)).y(), kSpeed, 1e-12);
}

TEST(GoalLimiterGuard, UsesHoldLimitWhileHandleIsReleased) {
  Touching t(kHold_n + 2.0);
  EXPECT_GE(t.go_to(Vector3(0.1, 0, 0)).x(), 0.0);
  t.let_go = true;
  EXPECT_NEAR(t.go_to(Vector3(0.1, 0, 0)).x(), -2.0 / (kStiffest_n_per_m * kBleed_s), 1e-12);
  t.contact.force_n = kHold_n - 2.0;
  EXPECT_GE(t.go_to(Vector3(0.1, 0, 0)).x(), 0.0);
}

TEST(GoalLimiterGuard, AboveTheGuardItBacksOutByTheStiffnessThatIsKnown) {
  for (const double stiffness : {0.0, 500.0, 5e3}) {
    Touching t(kGuard_n + 2.0);
    t.contact.stiffness_n_per_m = stiffness;
    const double k = stiffness > 0.0 ? stiffness : kStiffest_n_per_m;
    EXPECT_NEAR(t.go_to(Vector3(0.1, 0, 0)).x(), -2.0 / (k * kBleed_s), 1e-12) << stiffness;
    EXPECT_TRUE(t.out.force_guard);
    EXPECT_FALSE(t.out.force_persists);
  }
  Touching soft(kGuard_n + 10.0);
  soft.contact.stiffness_n_per_m = 10.0;
  EXPECT_LE(soft.go_to(Vector3(0.1, 0, 0), 100).norm(), kSpeed);
}

TEST(GoalLimiterGuard, AToolThatWasPushedInComesOutByTheStiffnessThatItShows) {
  for (const auto& [true_n_per_m, pushed_n] : {std::pair(400.0, 40.0), std::pair(5e3, 130.0)}) {
    for (const double reported_n_per_m : {0.0, 5e3, 6e5, 1e8}) {
      Touching t(pushed_n);
      t.contact.stiffness_n_per_m = reported_n_per_m;
      for (int i = 0; i < 4000; ++i) {
        t.go_to(Vector3(0.1, 0, 0), 1);
        t.contact.force_n = pushed_n + true_n_per_m * t.out.X_WE.p.x();
      }
      EXPECT_LT(t.contact.force_n, 1.15 * kGuard_n) << true_n_per_m << ' ' << reported_n_per_m;
      EXPECT_GT(t.contact.force_n, 0.8 * kGuard_n) << true_n_per_m << ' ' << reported_n_per_m;
    }
  }
}

TEST(GoalLimiterGuard, WhatIsStillComingIsTakenBackButNoFurther) {
  Touching t(kGuard_n);
  t.contact.lead_m = 1e-4;
  EXPECT_NEAR(t.go_to(Vector3(0.1, 0, 0), 100).x(), -std::sqrt(2.0 * kAcceleration * 1e-4), 1e-12);
  Touching behind(kGuard_n + 1.0);
  behind.contact.lead_m = -1e-3;  // the tool is ahead of its setpoint
  EXPECT_NEAR(behind.go_to(Vector3(0.1, 0, 0)).x(), -1.0 / (kStiffest_n_per_m * kBleed_s), 1e-12);
}

TEST(GoalLimiterGuard, DoesNotRetreatFromUntrustedOrGrowingForce) {
  for (const bool holds : {false, true}) {
    const auto moves_out = [&](bool trusted, const Vector3& grows) {
      Touching t(kGuard_n + 10.0);
      t.contact.stiffness_n_per_m = 1e3;
      t.contact.trusted = trusted;
      t.contact.grows = grows;
      return kOut.dot(holds ? t.hold(20) : t.go_to(Vector3(0.1, 0, 0), 20)) > 1e-4;
    };
    EXPECT_TRUE(moves_out(true, Vector3::Zero())) << holds;
    EXPECT_TRUE(moves_out(true, Vector3::UnitY())) << holds << ": across it is no matter";
    EXPECT_TRUE(moves_out(true, -kOut)) << holds;
    EXPECT_FALSE(moves_out(false, Vector3::Zero())) << holds;
    EXPECT_FALSE(moves_out(true, kOut)) << holds;
    EXPECT_FALSE(moves_out(true, (0.4 * kOut + Vector3::UnitY()).normalized())) << holds;
  }
}

TEST(GoalLimiterGuard, RetreatsTwentyMillimetresFromUnresponsiveForce) {
  for (const bool holds : {false, true}) {
    Touching t(kGuard_n + 10.0);
    t.contact.stiffness_n_per_m = 100.0;
    if (holds)
      t.hold(3000);
    else
      t.go_to(Vector3(0.1, 0, 0), 3000);
    EXPECT_NEAR(kOut.dot(t.limiter.setpoint().p), 0.02, 5e-4) << holds;
    EXPECT_TRUE(t.out.force_persists) << holds;
    EXPECT_TRUE(t.limiter.velocity().linear.isZero(1e-9)) << holds;
  }
}

TEST(GoalLimiterGuard, ForceAfterFiftyMillisecondGapIsNewContact) {
  for (const int stable_ticks : {40, 60}) {
    for (const double stable_n : {0.0, 15.0}) {
      Touching t(kGuard_n + 10.0);
      t.contact.stiffness_n_per_m = 100.0;
      t.go_to(Vector3(0.1, 0, 0), 3000);
      ASSERT_TRUE(t.out.force_persists);
      const Vector3 there_m = t.limiter.setpoint().p;
      t.contact.force_n = stable_n;
      t.contact.in_contact = stable_n > 0.0;
      t.go_to(there_m, stable_ticks);
      t.contact.in_contact = true;
      t.contact.force_n = kGuard_n + 10.0;
      t.go_to(there_m, 3000);
      EXPECT_NEAR(kOut.dot(t.limiter.setpoint().p - there_m), stable_ticks > 50 ? 0.02 : 0.0, 5e-4)
          << stable_ticks << ' ' << stable_n;
    }
  }
}

TEST(GoalLimiterGuard, AHoldComesDownByTheStiffnessThatIsKnown) {
  for (const double stiffness : {5e3, 2e4}) {
    Touching t(15.0);
    t.contact.stiffness_n_per_m = stiffness;
    const double speed = (15.0 - 0.95 * kHold_n) / (stiffness * kBleed_s);
    EXPECT_NEAR(kOut.dot(t.hold(1 + static_cast<int>(std::ceil(speed / (kAcceleration * kDt))))), speed,
                1e-9);
    EXPECT_NEAR(kOut.dot(t.hold(150)), std::min(10.0 * speed, kSpeed), 1e-9)
        << "a force that falls by less is that of a contact up to ten times as soft";
  }
}

TEST(GoalLimiterGuard, AHoldBelowItsLimitKeepsTheContactAsItIs) {
  for (const double force_n : {0.5, 5.0, 9.9}) {
    Touching t(force_n);
    t.hold();
    EXPECT_TRUE(t.limiter.at_rest()) << force_n;
    EXPECT_EQ(t.limiter.setpoint().p, Vector3::Zero()) << force_n;
    EXPECT_FALSE(t.out.force_persists);
  }
}

TEST(GoalLimiterGuard, AHoldThatHasBegunToComeDownGoesOnToItsAim) {
  Touching t(10.5);
  t.hold(5);
  ASSERT_GT(kOut.dot(t.limiter.velocity().linear), 0.0);
  t.contact.force_n = 9.8;  // below the limit, above the aim
  EXPECT_GT(kOut.dot(t.hold(5)), 0.0);
  t.contact.force_n = 9.5;
  t.hold(5);
  EXPECT_TRUE(t.limiter.at_rest());
  t.contact.force_n = 9.8;
  t.hold(5);
  EXPECT_TRUE(t.limiter.at_rest()) << "it has been there";
  t.contact.force_n = 10.5;
  t.hold(5);
  t.contact.in_contact = false;
  t.hold(5);
  EXPECT_TRUE(t.limiter.at_rest()) << "the contact is lost";
}

// Pushed in further, the force tells nothing of the stiffness: the stiffest is reckoned with again.
TEST(GoalLimiterGuard, AHoldThatIsPushedInDoesNotRushOut) {
  Touching t(15.0);
  t.hold(20);
  t.contact.force_n = 19.0;
  t.contact.lead_m = -5e-3;
  const double speed = (19.0 - 0.95 * kHold_n) / (kStiffest_n_per_m * kBleed_s);
  EXPECT_LE(kOut.dot(t.hold(1)), speed + 1e-12);
  EXPECT_GT(kOut.dot(t.limiter.velocity().linear), 0.0);
}

// A wall of 1 N/mm that the limiter knows nothing of, or takes for five times as stiff.
TEST(GoalLimiterGuard, AHoldIsDownWithinASecondWhateverIsKnown) {
  for (const double known : {0.0, 1e3, 5e3}) {
    constexpr double kWall_n_per_m = 1e3;
    Touching t(18.0);
    t.contact.stiffness_n_per_m = known;
    double least_n = 18.0;
    for (int i = 0; i < 1000; ++i) {
      t.hold(1);
      t.contact.force_n = 18.0 - kWall_n_per_m * kOut.dot(t.limiter.setpoint().p);
      least_n = std::min(least_n, t.contact.force_n);
    }
    EXPECT_LE(t.contact.force_n, kHold_n) << known;
    EXPECT_GE(least_n, 8.5) << known << ": the contact is kept";
  }
}

TEST(GoalLimiterGuard, AGoalWhoseTurnIsNotFiniteIsNone) {
  Touching t(0.0);
  t.contact.in_contact = false;
  t.go_to(Vector3(1, 0, 0), 100);
  Pose goal{Vector3(1, 0, 0), Quaternion::Identity()};
  goal.q.z() = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 300; ++i) t.limiter.step({goal, {}, kDt});
  EXPECT_TRUE(t.limiter.at_rest());
  EXPECT_TRUE(t.limiter.setpoint().q.coeffs().allFinite());
}

TEST(GoalLimiterGuard, WhatTheRobotCouldNotDoIsCorrectedWithinTheSpeedLimits) {
  Touching t(0.0);
  t.contact.in_contact = false;
  t.go_to(Vector3(1, 0, 0), 100);
  const Pose before = t.limiter.setpoint();
  t.go_to(Vector3(1, 0, 0), 1);
  const Pose there{before.p + Vector3(1e-4, 0, 0), exp_rotation(Vector3(0, 0, 1e-4))};
  t.limiter.correct(there, kDt);
  EXPECT_EQ(t.limiter.setpoint().p, there.p);
  EXPECT_NEAR(t.limiter.velocity().linear.x(), 0.1, 1e-9);
  EXPECT_NEAR(t.limiter.velocity().angular.z(), 0.1, 1e-9);
  t.limiter.correct({before.p + Vector3(0, 1, 0), exp_rotation(Vector3(0, 0, 1))}, kDt);
  EXPECT_NEAR(t.limiter.velocity().linear.norm(), kSpeed, 1e-12);
  EXPECT_NEAR(t.limiter.velocity().angular.norm(), 0.3, 1e-12);
}

// What presses shall be backed out of faster than the tool may go, while it still moves along the surface.
TEST(Pursue, BacksOutWithinItsSpeedWhileTheRestOfTheMotionEnds) {
  const VectorLimits limits{.speed = 0.15, .acceleration = 1.25, .dt = 1e-3};
  VectorPursuit p{.velocity = {-0.05, 0.14, 0.0}, .goal_velocity = {0.1, 0.1, 0.0}};
  p.caps[0] = {.direction = Vector3::UnitX(), .speed = -1.0, .active = true};
  for (int i = 0; i < 400; ++i) {
    const Vector3 velocity = pursue(p, limits).velocity;
    EXPECT_LE(velocity.norm(), limits.speed * (1 + 1e-12)) << i;
    EXPECT_LE((velocity - p.velocity).norm(), limits.acceleration * limits.dt * (1 + 1e-9)) << i;
    p.velocity = velocity;
  }
  EXPECT_NEAR(p.velocity.x(), -limits.speed, 1e-3);
}

TEST(GoalLimiterGuard, RetreatsAtGivenSpeedForAnyGoal) {
  constexpr double kRetreat = 0.01;
  Touching t(18.0);
  t.contact.gives_way = t.contact.gave_way = true;
  t.contact.retreat_m_per_s = kRetreat;
  t.contact.trend_n_per_s = 20.0;  // at rest: what it does not grow by is its answer
  EXPECT_NEAR(t.go_to(Vector3(2, 0, 0)).x(), -kRetreat, 1e-12);
  EXPECT_TRUE(t.out.force_guard);
  t.contact.force_n = 0.9 * kHold_n;
  EXPECT_NEAR(t.hold().x(), -kRetreat, 1e-12);
  // What was given counts till the contact ends; below the guard the tool goes on meanwhile.
  t.contact.gives_way = false;
  t.contact.force_n = 15.0;
  EXPECT_GT(t.go_to(Vector3(2, 0, 0), 1000).x(), 0.0);
  EXPECT_FALSE(t.out.force_persists);
  t.contact.force_n = 25.0;
  EXPECT_LT(t.go_to(Vector3(2, 0, 0)).x(), 0.0);
  t.contact.in_contact = false;
  EXPECT_GT(t.go_to(Vector3(2, 0, 0)).x(), 0.2);
  EXPECT_FALSE(t.out.force_persists);
}

/// Likewise of a contact by rotation about z, that turns the tool back.
struct Turning : Touching {
  ContactForce moment{.in_contact = true, .reaction = -Vector3::UnitZ()};

  explicit Turning(double moment_nm) : Touching(0.0) {
    contact.in_contact = false;
    moment.force_n = moment_nm;
  }
  double turn_to(double rad, int ticks = 300) {
    const Pose goal{Vector3::Zero(), Quaternion(Eigen::AngleAxisd(rad, Vector3::UnitZ()))};
    for (int i = 0; i < ticks; ++i) out = limiter.step({goal, contact, kDt, let_go, moment});
    return limiter.velocity().angular.z();
  }
};

TEST(GoalLimiterGuard, TheMomentGuardHoldsTheToolAndTheWayBackIsFree) {
  Turning at(CommandConfig{}.moment_guard_nm);
  EXPECT_NEAR(at.turn_to(1.0), 0.0, 1e-9);
  EXPECT_TRUE(at.out.moment_guard);
  EXPECT_FALSE(at.out.force_guard);
  EXPECT_LT(at.turn_to(-1.0), -0.1);
  EXPECT_FALSE(at.out.moment_guard);
}

TEST(GoalLimiterGuard, WhereTheMomentGrowsTheTurnIsBounded) {
  Turning about_x(CommandConfig{}.moment_guard_nm);
  about_x.moment.reaction = Vector3::UnitX();
  about_x.moment.grows = Vector3::UnitZ();
  EXPECT_NEAR(about_x.turn_to(1.0), 0.0, 1e-9);
  EXPECT_TRUE(about_x.out.moment_guard);
}

TEST(GoalLimiterGuard, HoldBoundsRetreatFromJerkyWall) {
  constexpr double kWay_m = 0.015;
  CommandConfig config;
  config.give_way_m = kWay_m;
  Touching t(0.0);
  t.limiter.configure(config);
  t.contact.stiffness_n_per_m = 300.0;
  for (int jerk = 0; jerk < 40; ++jerk) {
    for (int i = 0; i < 150; ++i) {
      t.contact.in_contact = i < 50;
      t.contact.reaction = i < 50 ? kOut : Vector3::Zero();
      t.contact.force_n = i < 50 ? 15.0 : 0.0;
      t.hold(1);
    }
  }
  EXPECT_LT(-t.out.X_WE.p.x(), 1.01 * kWay_m) << "with what it goes on while it brakes";
  EXPECT_GT(-t.out.X_WE.p.x(), 0.9 * kWay_m);
}

TEST(GoalLimiterGuard, GivesWayInAHoldNoFartherThanTheWorkspace) {
  CommandConfig config;
  config.workspace_m = 0.2;
  for (const double towards : {1.0, -1.0}) {  // the edge is behind the tool, or before it
    Touching t(0.0);
    t.limiter = GoalLimiter(config, Vector3(towards * 0.1999, 0, 0));
    t.limiter.reset({});
    t.contact.force_n = 25.0;
    for (int i = 0; i < 1000; ++i) t.hold(1);
    const double way_m = -t.out.X_WE.p.x();
    EXPECT_GT(way_m, 0.0);
    if (towards > 0.0) {
      EXPECT_LE(way_m, 1.1e-4);
    }
    if (towards < 0.0) {
      EXPECT_GT(way_m, 1e-3);
    }
  }
}

}  // namespace
}  // namespace longreach::goal_limiter_guard_test
