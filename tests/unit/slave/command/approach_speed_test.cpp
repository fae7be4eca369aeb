#include "slave/command/approach_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace longreach::approach_speed_test {
namespace {

constexpr double kStiff = 2e4, kGuard_n = 20.0;

CommandConfig command(double braking_m_per_s2 = 10.0) {
  CommandConfig c;
  c.force_guard_n = kGuard_n;
  c.guard_stiffness_n_per_m = kStiff;
  c.braking_max_m_per_s2 = braking_m_per_s2;
  return c;
}

/// A robot without lag, whose touch is detected at once.
FirstTouch prompt() {
  return {.stiffness_n_per_m = kStiff, .guard_stiffness_n_per_m = kStiff, .lag_s = 1e-3, .touch_n = 1e-6};
}

// Of k (v t + v²/(2 a)) = 1.35 G.
double by_closed_form(double lag_s, double a) {
  const double depth_m = kGuardOvershoot * kGuard_n / kStiff;
  return a * (std::sqrt(lag_s * lag_s + 2.0 * depth_m / a) - lag_s);
}

TEST(ApproachSpeed, IsThatOfTheClosedFormForARobotWithoutLag) {
  for (const double a : {1.25, 5.0, 10.0}) {
    const ApproachSpeed approach(command(a), prompt());
    EXPECT_NEAR(approach.speed_m_per_s(), by_closed_form(1e-3, 0.95 * std::max(a, 1.25 / 0.95)), 3e-3) << a;
  }
}

TEST(ApproachSpeed, FallsWithTheLagOfTheRobotAndTheGuard) {
  FirstTouch slow = prompt();
  slow.servo_s = 0.02;
  const double quick_m_per_s = ApproachSpeed(command(), prompt()).speed_m_per_s();
  const double slow_m_per_s = ApproachSpeed(command(), slow).speed_m_per_s();
  EXPECT_LT(slow_m_per_s, 0.8 * quick_m_per_s);
  CommandConfig low = command();
  low.force_guard_n = 5.0;
  EXPECT_LT(ApproachSpeed(low, slow).speed_m_per_s(), 0.5 * slow_m_per_s);
}

TEST(ApproachSpeed, IsNotAboveWhatTheJointsCanBrake) {
  ApproachSpeed approach(command(), prompt());
  const double strong_m_per_s = approach.speed_m_per_s();
  approach.permit(2.5);
  EXPECT_DOUBLE_EQ(approach.braking_m_per_s2(), 2.0);
  EXPECT_LT(approach.speed_m_per_s(), 0.6 * strong_m_per_s);
  approach.permit(std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(approach.braking_m_per_s2(), 10.0);
  EXPECT_DOUBLE_EQ(approach.speed_m_per_s(), strong_m_per_s);
  approach.permit(0.01);
  EXPECT_DOUBLE_EQ(approach.braking_m_per_s2(), 1.25) << "what every motion may use";
  approach.permit(5.0);
  const double found_m_per_s = approach.speed_m_per_s();
  approach.permit(5.5);
  EXPECT_EQ(approach.speed_m_per_s(), found_m_per_s) << "a small change to the safe side";
}

TEST(ApproachSpeed, IsUnlimitedWithoutAForceGuard) {
  ApproachSpeed approach(command(), std::nullopt);
  EXPECT_TRUE(std::isinf(approach.speed_m_per_s()));
  approach.permit(2.5);
  EXPECT_TRUE(std::isinf(approach.speed_m_per_s()));
}

}  // namespace
}  // namespace longreach::approach_speed_test
