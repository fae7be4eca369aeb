#include "slave/command/goal_limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/random.hpp"

namespace longreach::goal_limiter_test {
namespace {

constexpr double kDt = 1e-3;

Vector3 random_vector(Random& random, double size) {
  return size * Vector3(random.normal(), random.normal(), random.normal());
}

// Watches finite differences of the setpoints: speed and acceleration as the robot sees them.
struct Watch {
  Pose before{};
  Twist velocity{};
  double speed = 0.0, acceleration = 0.0, turn = 0.0, turn_acceleration = 0.0;

  void see(const Pose& X) {
    const Twist v{log_rotation(X.q * before.q.conjugate()) / kDt, (X.p - before.p) / kDt};
    speed = std::max(speed, v.linear.norm());
    turn = std::max(turn, v.angular.norm());
    acceleration = std::max(acceleration, (v.linear - velocity.linear).norm() / kDt);
    turn_acceleration = std::max(turn_acceleration, (v.angular - velocity.angular).norm() / kDt);
    before = X;
    velocity = v;
  }
  void expect_within(const CommandConfig& c) const {
    EXPECT_LE(speed, c.speed_max_m_per_s * (1 + 1e-6));
    EXPECT_LE(acceleration, c.acceleration_max_m_per_s2 * (1 + 1e-6));
    EXPECT_LE(turn, c.speed_max_rad_per_s * (1 + 1e-6));
    EXPECT_LE(turn_acceleration, c.acceleration_max_rad_per_s2 * (1 + 1e-6));
  }
};

/// Ends every line.
struct EndOfReach : ReachLimit {
  Twist limit(const Pose&, const Twist&, const Twist&, double) override { return {}; }
  [[nodiscard]] bool ended() const override { return true; }
};

TEST(GoalLimiter, MovesNoFartherThanTheJointsReach) {
  GoalLimiter limiter(CommandConfig{}, Vector3::Zero());
  EndOfReach end;
  LimiterInput input{.X_WE_goal = Pose{{0.1, 0, 0}, Quaternion::Identity()}, .dt = kDt, .reach = &end};
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(limiter.step(input).reach);
  EXPECT_EQ(limiter.setpoint().p, Vector3::Zero());
  EXPECT_TRUE(limiter.at_rest());
  input.reach = nullptr;
  EXPECT_FALSE(limiter.step(input).reach);
  EXPECT_FALSE(limiter.at_rest());
}

TEST(BrakingSpeed, StepsOfBrakingEndExactlyThere) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double distance = std::pow(10.0, random.uniform(-9.0, 1.0));
    double left = distance, v = 0.0;
    for (int i = 0; left > 1e-15 && i < 100000; ++i) {
      const double next = braking_speed(left, 1.0, kDt);
      if (i > 0) {
        ASSERT_GE(next, v - 1.0 * kDt - 1e-12) << "trial " << trial;
      }
      v = next;
      left -= v * kDt;
    }
    EXPECT_NEAR(left, 0.0, 1e-14 + 1e-12 * distance);
    EXPECT_LE(v, 1.0 * kDt * (1 + 1e-6));  // the last step can stop at once
    // Never more than the continuous law by more than half a step of speed.
    EXPECT_LE(braking_speed(distance, 1.0, kDt), std::sqrt(2.0 * distance) + kDt);
  }
}

TEST(GoalLimiter, NeverExceedsItsLimitsWhateverTheGoalDoes) {
  const CommandConfig config;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    GoalLimiter limiter(config, Vector3::Zero());
    limiter.reset({});
    Watch watch;
    LimiterInput in;
    in.dt = kDt;
    in.X_WE_goal = Pose{};
    for (int i = 0; i < 4000; ++i) {
      if (random.chance(0.01))
        in.X_WE_goal = Pose{random_vector(random, 1.0), exp_rotation(random_vector(random, 1.0))};
      if (random.chance(0.005)) in.X_WE_goal.reset();
      if (random.chance(0.005))
        in.X_WE_goal = Pose{random_vector(random, 1e9), exp_rotation(random_vector(random, 1e-9))};
      if (random.chance(0.01)) {
        in.contact = {random.chance(0.5), random_vector(random, 1.0).normalized(), random.uniform(0.0, 30.0)};
      }
      if (in.X_WE_goal && random.chance(0.3)) in.X_WE_goal->p += random_vector(random, 1e-4);
      watch.see(limiter.step(in).X_WE);
      ASSERT_LE(watch.before.p.norm(), config.workspace_m + 1e-9) << "seed " << seed;
    }
    watch.expect_within(config);
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
  }
}

TEST(GoalLimiter, ReachesAStillGoalExactlyAndWithoutOvershoot) {
  const CommandConfig config;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-7.0, 0.0));
    const Pose goal{random_vector(random, size).cwiseMax(-1.5).cwiseMin(1.5),
                    exp_rotation(random_vector(random, size))};
    GoalLimiter limiter(config, Vector3::Zero());
    limiter.reset({});
    Watch watch;
    const Vector3 way = goal.p.normalized();
    const Vector3 turn = log_rotation(goal.q);
    for (int i = 0; i < 30000; ++i) {
      watch.see(limiter.step({goal, {}, kDt}).X_WE);
      ASSERT_LE(way.dot(watch.before.p), goal.p.norm() + 1e-12) << "seed " << seed;
      ASSERT_LE(turn.normalized().dot(log_rotation(watch.before.q)), turn.norm() + 1e-12) << "seed " << seed;
    }
    EXPECT_LT((watch.before.p - goal.p).norm(), 1e-12) << "seed " << seed;
    EXPECT_LT(watch.before.q.angularDistance(goal.q), 1e-12) << "seed " << seed;
    watch.expect_within(config);
  }
}

TEST(GoalLimiter, BrakesInTimeAndNotMuchTooEarly) {
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  const Pose goal{Vector3(0.5, 0, 0), Quaternion::Identity()};
  int ticks = 0;
  while ((limiter.setpoint().p - goal.p).norm() > 1e-9 && ticks < 100000) {
    limiter.step({goal, {}, kDt});
    ++ticks;
  }
  const double optimal = 0.5 / 0.25 + 0.25 / 1.25;  // trapezium of the limits
  EXPECT_GE(ticks * kDt, optimal - 2 * kDt);
  EXPECT_LE(ticks * kDt, optimal + 0.05);
}

TEST(GoalLimiter, FollowsAGoalWithinTheLimitsWithoutLag) {
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  for (int i = 0; i < 10000; ++i) {
    const double t = i * kDt, w = 2.0;
    // Starts away from the setpoint: it has to catch up first.
    const Pose goal{Vector3(0.02 + 0.05 * std::sin(w * t), 0.05 * (1 - std::cos(w * t)), 0.01 * t),
                    exp_rotation(Vector3(0.05 * std::sin(w * t), 0, 0.1 * (1 - std::cos(w * t))))};
    limiter.step({goal, {}, kDt});
    if (t > 2.0) {
      ASSERT_LT((limiter.setpoint().p - goal.p).norm(), 1e-11) << t;
      ASSERT_LT(limiter.setpoint().q.angularDistance(goal.q), 1e-8) << t;
    }
  }
}

TEST(GoalLimiter, BrakesToAStandWithoutAGoalAndStays) {
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  Watch watch;
  for (int i = 0; i < 500; ++i)
    watch.see(limiter.step({Pose{Vector3(2, 0, 0), exp_rotation(Vector3(0, 1, 0))}, {}, kDt}).X_WE);
  const Vector3 began = watch.before.p;
  const double v = watch.velocity.linear.norm();
  EXPECT_NEAR(v, 0.25, 1e-9);
  for (int i = 0; i < 250; ++i) watch.see(limiter.step({std::nullopt, {}, kDt}).X_WE);
  EXPECT_NEAR((watch.before.p - began).norm(), v * v / (2 * 1.25), v * kDt);
  EXPECT_TRUE(limiter.at_rest());
  const Vector3 stopped = watch.before.p;
  for (int i = 0; i < 1000; ++i) limiter.step({std::nullopt, {}, kDt});
  EXPECT_EQ(limiter.setpoint().p, stopped);
  watch.expect_within(config);
}

TEST(GoalLimiter, KeepsTheWorkspaceEvenIfTheGoalFliesOut) {
  CommandConfig config;
  config.workspace_m = 0.3;
  GoalLimiter limiter(config, Vector3(1, 2, 3));
  limiter.reset({Vector3(1, 2, 3), Quaternion::Identity()});
  bool reported = false;
  Watch watch;
  watch.before = limiter.setpoint();
  for (int i = 0; i < 5000; ++i) {
    const double x = std::min(0.5 * 0.5 * std::pow(i * kDt, 2), 0.24 * i * kDt);  // fast, within the limits
    const LimiterOutput out = limiter.step({Pose{Vector3(1 + x, 2, 3), Quaternion::Identity()}, {}, kDt});
    watch.see(out.X_WE);
    ASSERT_LE((out.X_WE.p - Vector3(1, 2, 3)).norm(), 0.3 + 1e-9);
    reported = reported || out.workspace;
  }
  EXPECT_TRUE(reported);
  EXPECT_NEAR(watch.before.p.x(), 1.3, 1e-6);
  watch.expect_within(config);
}

TEST(GoalLimiter, TheGuardStopsTheAdvanceAndLeavesTheWayBackFree) {
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  const ContactForce full{true, Vector3(-1, 0, 0), 25.0};
  for (int i = 0; i < 100; ++i) {
    const LimiterOutput out = limiter.step({Pose{Vector3(0.1, 0.05, 0), Quaternion::Identity()}, full, kDt});
    EXPECT_TRUE(out.force_guard);
    EXPECT_LE(out.X_WE.p.x(), 1e-15);
  }
  EXPECT_GT(limiter.setpoint().p.y(), 1e-3);  // along the wall it may go
  const double x = limiter.setpoint().p.x();
  for (int i = 0; i < 500; ++i) limiter.step({Pose{Vector3(-0.1, 0, 0), Quaternion::Identity()}, full, kDt});
  EXPECT_LT(limiter.setpoint().p.x(), x - 0.05);
}

TEST(GoalLimiter, TheGuardFollowsTheBrakingLawBelowItsForce) {
  const CommandConfig config;
  for (const double force : {0.0, 5.0, 15.0, 19.9}) {
    GoalLimiter limiter(config, Vector3::Zero());
    limiter.reset({});
    const Vector3 n = Vector3(-1, 1, 0).normalized();
    for (int i = 0; i < 400; ++i)
      limiter.step({Pose{-1.0 * n, Quaternion::Identity()}, {true, n, force}, kDt});
    const double allowed = std::sqrt(2 * 1.25 * (20.0 - force) / 2e4);
    EXPECT_NEAR(-n.dot(limiter.velocity().linear), std::min(allowed, 0.25), 1e-12) << force;
  }
}

// The stop of a 50 mm/s approach on 5 N/mm through the robot's servo lag.
TEST(GoalLimiter, TheGuardBoundsThePeakForceOfAFastTouch) {
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  double tool = 0.0, peak = 0.0;
  const double wall = 0.1;
  for (int i = 0; i < 6000; ++i) {
    const double force = std::max(0.0, 5000.0 * (tool - wall));
    peak = std::max(peak, force);
    const Pose goal{Vector3(std::min(0.05 * i * kDt, 0.2), 0, 0), Quaternion::Identity()};
    limiter.step({goal, {force > 0.5, Vector3(-1, 0, 0), force}, kDt});
    tool += (limiter.setpoint().p.x() - tool) * -std::expm1(-62.83 * kDt);
  }
  EXPECT_GT(peak, 15.0);  // it does press
  EXPECT_LT(peak, 1.35 * config.force_guard_n);
}

TEST(GoalLimiter, BrakesForAGoalThatIsNotFinite) {
  GoalLimiter limiter(CommandConfig{}, Vector3::Zero());
  limiter.reset({});
  Pose goal{Vector3(1, 0, 0), Quaternion::Identity()};
  for (int i = 0; i < 100; ++i) limiter.step({goal, {}, kDt});
  goal.p.y() = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 300; ++i) limiter.step({goal, {}, kDt});
  EXPECT_TRUE(limiter.at_rest());
  EXPECT_TRUE(limiter.setpoint().p.allFinite());
}

// Out, back and out again: only where the tool has been it is fast.
TEST(GoalLimiter, IsSlowInUnknownSpaceAndFastWhereItHasBeen) {
  constexpr double kSlow_m_per_s = 0.05, kOut_m = 0.2;
  const CommandConfig config;
  GoalLimiter limiter(config, Vector3::Zero());
  limiter.reset({});
  limiter.renew();
  LimiterInput in;
  in.dt = kDt;
  in.approach_m_per_s = kSlow_m_per_s;
  // Returns the largest speed until the goal is reached, and beyond `beyond_m`.
  const auto drive = [&](double x_m, double beyond_m) {
    std::pair<double, double> most{};
    in.X_WE_goal = Pose{{x_m, 0.0, 0.0}, Quaternion::Identity()};
    for (int i = 0; i < 8000; ++i) {
      in.tool_m = limiter.setpoint().p;
      const LimiterOutput out = limiter.step(in);
      const double speed = limiter.velocity().linear.norm();
      most.first = std::max(most.first, speed);
      if (in.tool_m.x() > beyond_m) most.second = std::max(most.second, speed);
      if (in.tool_m.x() > beyond_m && speed > 0.0) {
        EXPECT_TRUE(out.unknown_space) << in.tool_m.x();
      }
    }
    EXPECT_NEAR(limiter.setpoint().p.x(), x_m, 1e-9);
    return most;
  };
  EXPECT_LE(drive(kOut_m, 0.0).second, kSlow_m_per_s * (1 + 1e-9));
  EXPECT_GT(drive(0.0, INFINITY).first, 2.0 * kSlow_m_per_s);
  const auto [most, beyond] = drive(kOut_m + 0.1, kOut_m);
  EXPECT_GT(most, 2.0 * kSlow_m_per_s);
  EXPECT_LE(beyond, kSlow_m_per_s * (1 + 1e-9));
}

}  // namespace
}  // namespace longreach::goal_limiter_test
