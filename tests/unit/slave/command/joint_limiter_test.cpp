#include "slave/command/joint_limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "tests/support/allocations.hpp"

namespace longreach::joint_limiter_test {
namespace {

constexpr double kDt = 1e-3;

// Six joints alike: 1 rad/s, 4 rad/s², 500 rad/s³, ±1 rad. 2 · 4/(500 · 1e-3) = 16 ticks.
RobotConfig six_alike() {
  RobotConfig robot;
  for (JointConfig& j : robot.joint) {
    j.min_rad = -1.0, j.max_rad = 1.0;
    j.speed_max_rad_per_s = 1.0;
    j.acceleration_max_rad_per_s2 = 4.0;
    j.jerk_max_rad_per_s3 = 500.0;
  }
  return robot;
}

// Largest differences of a row of setpoints.
struct Differences {
  JointVector q = JointVector::Zero(), v = JointVector::Zero(), a = JointVector::Zero();
  double position = 0.0, speed = 0.0, acceleration = 0.0, jerk = 0.0;

  void see(const JointVector& next) {
    const JointVector v_next = (next - q) / kDt, a_next = (v_next - v) / kDt;
    position = std::max(position, next.cwiseAbs().maxCoeff());
    speed = std::max(speed, v_next.cwiseAbs().maxCoeff());
    acceleration = std::max(acceleration, a_next.cwiseAbs().maxCoeff());
    jerk = std::max(jerk, ((a_next - a) / kDt).cwiseAbs().maxCoeff());
    q = next, v = v_next, a = a_next;
  }
  void expect_within(double acceleration_max = 4.0, double jerk_max = 500.0) const {
    EXPECT_LE(position, 1.0);
    EXPECT_LE(speed, 1.0 + 1e-9);
    EXPECT_LE(acceleration, acceleration_max * (1 + 1e-7));
    EXPECT_LE(jerk, jerk_max * (1 + 1e-6));
  }
};

TEST(JointLimiter, KeepsAllLimitsWhateverIsAskedFor) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    JointLimiter limiter(six_alike());
    limiter.reset(JointVector::Zero());
    Differences seen;
    JointVector wanted = JointVector::Zero();
    for (int i = 0; i < 5000; ++i) {
      if (random.chance(0.02)) {
        for (double& x : wanted)
          x = random.chance(0.1) ? random.uniform(-1e9, 1e9) : random.uniform(-1.0, 1.0);
      }
      limiter.step(wanted, {}, kDt);
      seen.see(limiter.setpoint_rad());
    }
    seen.expect_within();
    EXPECT_GT(seen.jerk, 400.0);  // it is used, too
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
  }
}

TEST(JointLimiter, WhatKeepsTheLimitsPassesUnchangedHalfAWindowLater) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Zero());
  for (int i = 1; i <= 3000; ++i) {
    const auto at = [](double t) {
      return JointVector(JointVector::Constant(0.1 * (1.0 - std::cos(2.0 * t))));
    };
    const JointsLimited limited = limiter.step(at(i * kDt), {}, kDt);
    ASSERT_FALSE(limited.any()) << i;
    EXPECT_EQ(limiter.path_rad(), at(i * kDt));
    if (i < 16) continue;
    // The mean of a cosine over 16 ticks: 7.5 ticks later, and by 1 - (ω T)²/24 smaller.
    EXPECT_LT((limiter.setpoint_rad() - at((i - 7.5) * kDt)).cwiseAbs().maxCoeff(), 1e-5) << i;
  }
}

TEST(JointLimiter, StopsAtAPositionLimitInTimeAndNotMuchTooEarly) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Zero());
  Differences seen;
  int ticks = 0;
  for (; ticks < 3000 && !(limiter.setpoint_rad()[0] > 1.0 - 1e-9); ++ticks) {
    limiter.step(JointVector::Constant(5.0), {}, kDt);
    seen.see(limiter.setpoint_rad());
  }
  seen.expect_within();
  // Up at 4 rad/s² to 1 rad/s, down at half of it, and the window of 16 ms.
  const double swiftest_s = 1.0 / 1.0 + 0.5 * (1.0 / 4.0 + 1.0 / 2.0);
  EXPECT_NEAR(ticks * kDt, swiftest_s + 0.016, 0.01);
  for (int i = 0; i < 100; ++i) limiter.step(JointVector::Constant(5.0), {}, kDt);
  EXPECT_EQ(limiter.setpoint_rad(), JointVector::Constant(1.0));
  // And comes back at once.
  for (int i = 0; i < 200; ++i) limiter.step(JointVector::Constant(0.5), {}, kDt);
  EXPECT_LT(limiter.setpoint_rad()[0], 0.95);
}

TEST(JointLimiter, SlowsAllJointsAlikeForTheSlowest) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Zero());
  JointVector step;
  step << 0.004, 0.002, -0.001, 0.0, 0.003, -0.004;  // 4 rad/s at most
  bool limited = false;
  for (int i = 0; i < 500; ++i) {
    const JointVector before = limiter.path_rad();
    limited = limiter.step(before + step, {}, kDt).speed || limited;
    const JointVector moved = limiter.path_rad() - before;
    EXPECT_LT((moved - step * (moved[0] / step[0])).norm(), 1e-12);
  }
  EXPECT_TRUE(limited);
  EXPECT_NEAR(limiter.path_rad()[0], 0.5 - 0.5 / 8.0, 0.13);
}

TEST(JointLimiter, KeepsTheToolWithinItsSpeedsOnEveryWay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    ToolBound tool;
    for (int i = 0; i < 18; ++i) tool.J(3 + i / 6, i % 6) = random.uniform(-3.0, 3.0);  // sliding joints
    JointLimiter limiter(six_alike());
    limiter.reset(JointVector::Zero());
    JointVector wanted = JointVector::Zero();
    double most = 0.0;
    for (int i = 0; i < 5000; ++i) {
      if (random.chance(0.02)) {
        for (double& x : wanted) x = random.uniform(-0.5, 0.5);
      }
      const JointVector before = limiter.setpoint_rad();
      limiter.step(wanted, tool, kDt);
      most = std::max(most, tool.share(tool.J * (limiter.setpoint_rad() - before) / kDt));
    }
    EXPECT_LE(most, 1.0 + 1e-9) << "seed " << seed;
    EXPECT_GT(most, 0.9) << "seed " << seed;  // it is used, too
  }
}

// Two links of 1 m in a plane: x = cos q₁ + cos(q₁ + q₂), y alike. Its tool's velocity in closed form.
struct TwoLinks {
  static Vector6 velocity(const JointVector& q, const JointVector& v) {
    Vector6 V = Vector6::Zero();
    const double a = q[0], b = q[0] + q[1], w = v[0] + v[1];
    V[2] = w;
    V[3] = -std::sin(a) * v[0] - std::sin(b) * w;
    V[4] = std::cos(a) * v[0] + std::cos(b) * w;
    return V;
  }
  static ToolBound bound(const JointVector& q, double rad_per_s, double m_per_s) {
    ToolBound tool;
    for (int i = 0; i < 2; ++i) tool.J.col(i) = velocity(q, JointVector::Unit(i));
    tool.rad_per_s = rad_per_s, tool.m_per_s = m_per_s;
    return tool;
  }
};

TEST(ToolBound, KnowsHowTheToolTurnsWhileTheJointsKeepTheirSpeeds) {
  JointVector q = JointVector::Zero(), v = JointVector::Zero();
  q << 0.3, -0.8, 0.0, 0.0, 0.0, 0.0;
  v << 0.7, -1.9, 0.0, 0.0, 0.0, 0.0;
  constexpr double kStep = 1e-5;
  const Vector6 seen =
      (TwoLinks::velocity(q + kStep * v, v) - TwoLinks::velocity(q - kStep * v, v)) / (2 * kStep);
  EXPECT_LT((TwoLinks::bound(q, 1.0, 1.0).turn(v) - seen).norm(), 1e-8);
}

// Quick joints that hardly move the tool, as they go through a singular pose, do when the arm has turned a
// little.
TEST(JointLimiter, TheToolKeepsItsSpeedWhileTheArmChangesItsShape) {
  RobotConfig robot = six_alike();
  for (JointConfig& j : robot.joint) j.min_rad = -3.0, j.max_rad = 3.0, j.speed_max_rad_per_s = 3.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    JointLimiter limiter(robot);
    JointVector q = JointVector::Zero(), goal = JointVector::Zero();
    q.head<2>() << random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0);
    limiter.reset(q);
    double most = 0.0;
    for (int i = 0; i < 4000; ++i) {
      if (i % 500 == 0) goal.head<2>() << random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0);
      const ToolBound tool = TwoLinks::bound(limiter.path_rad(), 3.0, 0.2);
      const JointVector before = limiter.setpoint_rad();
      limiter.step(goal, tool, kDt);
      const JointVector middle = 0.5 * (before + limiter.setpoint_rad());
      most = std::max(most, tool.share(TwoLinks::velocity(middle, (limiter.setpoint_rad() - before) / kDt)));
    }
    EXPECT_LE(most, 1.01) << "seed " << seed;
    EXPECT_GT(most, 0.5) << "seed " << seed;
  }
}

TEST(JointLimiter, RestIsExactAndSettled) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Constant(0.1));
  const JointVector goal = JointVector::Constant(0.1 + 1e-3 / 3.0);
  for (int i = 0; i < 2; ++i) limiter.step(limiter.path_rad() + JointVector::Constant(1e-6), {}, kDt);
  EXPECT_FALSE(limiter.settled());
  const JointVector stays = limiter.path_rad();
  for (int i = 0; i < 20; ++i) limiter.step(stays, {}, kDt);
  EXPECT_TRUE(limiter.at_rest());
  EXPECT_TRUE(limiter.settled());
  EXPECT_EQ(limiter.setpoint_rad(), stays);
  EXPECT_NE(stays, goal);
}

TEST(JointLimiter, SmallJerkLimitLowersAcceleration) {
  RobotConfig robot = six_alike();
  for (JointConfig& j : robot.joint) j.jerk_max_rad_per_s3 = 1.0;  // 8 s of window otherwise
  JointLimiter limiter(robot);
  limiter.reset(JointVector::Zero());
  Differences seen;
  for (int i = 0; i < 20000; ++i) {
    limiter.step(JointVector::Constant(i < 5000 ? 0.4 : -0.4), {}, kDt);
    seen.see(limiter.setpoint_rad());
  }
  seen.expect_within(0.5 * 1.0 * JointLimiter::kTicksMax * kDt, 1.0);
}

TEST(JointLimiter, MovesJointsOutsideTheirLimitsInside) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Constant(7.0));
  EXPECT_EQ(limiter.setpoint_rad(), JointVector::Constant(1.0));
  limiter.reset(JointVector::Constant(-7.0));
  EXPECT_EQ(limiter.setpoint_rad(), JointVector::Constant(-1.0));
}

TEST(JointLimiter, ReachesAllowedGoalInOneStep) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Zero());
  limiter.step(JointVector::Zero(), {}, kDt);
  EXPECT_TRUE(limiter.reaches(JointVector::Constant(0.9 * 4.0 * kDt * kDt), kDt));
  EXPECT_FALSE(limiter.reaches(JointVector::Constant(1.1 * 4.0 * kDt * kDt), kDt)) << "acceleration";
  for (int i = 0; i < 200; ++i) limiter.step(JointVector::Constant(1.0), {}, kDt);
  const JointVector on = limiter.path_rad() + JointVector::Constant(0.8 * kDt);
  EXPECT_FALSE(limiter.reaches(on, kDt)) << "faster than a slow change of the arm's shape";
}

TEST(JointLimiter, StepAllocatesNothing) {
  JointLimiter limiter(six_alike());
  limiter.reset(JointVector::Zero());
  test::count_allocations(true);
  for (int i = 0; i < 100; ++i) limiter.step(JointVector::Constant(0.5), {}, kDt);
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
}

TEST(JointLimiter, BrakesInTheTimeOfTheSlowestJoint) {
  const JointLimiter limiter(six_alike());
  JointVector rad_per_s = JointVector::Zero();
  EXPECT_EQ(limiter.braking_s(rad_per_s), 0.0);
  rad_per_s[1] = 0.2;
  rad_per_s[4] = -0.8;
  EXPECT_DOUBLE_EQ(limiter.braking_s(rad_per_s), 0.2);
}

}  // namespace
}  // namespace longreach::joint_limiter_test
