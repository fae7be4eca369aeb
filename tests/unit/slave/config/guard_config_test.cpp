#include "slave/config/guard_config.hpp"

#include <gtest/gtest.h>

namespace longreach::guard_config_test {
namespace {

/// Deepest place of a tool that follows its setpoint with the lag τ, step by step: at v until the setpoint is
/// told, `late_s` after the touch; then the setpoint brakes at a and turns back.
double deepest_m(double v, double a, double late_s, double servo_s) {
  constexpr double kStep_s = 1e-6;
  double tool_m = 0.0, setpoint_m = v * servo_s, speed = v, deepest = 0.0;
  for (double t = 0.0; t < late_s + 4.0 * (v / a + servo_s); t += kStep_s) {
    if (t >= late_s) speed -= a * kStep_s;
    setpoint_m += speed * kStep_s;
    tool_m = servo_s > 0.0 ? tool_m + kStep_s / servo_s * (setpoint_m - tool_m) : setpoint_m;
    deepest = std::max(deepest, tool_m);
  }
  return deepest;
}

TEST(GuardConfig, TheLeastGuardIsThatOfTheDeepestPlaceOfAFirstTouch) {
  for (const double servo_s : {0.0, 0.016, 0.053}) {
    for (const double lag_s : {0.0, 0.003, 0.02}) {
      FirstTouch touch{.lag_s = lag_s, .servo_s = servo_s};
      const double late_s = lag_s + touch.touch_n / (touch.stiffness_n_per_m * touch.speed_m_per_s);
      const double peak_n = touch.stiffness_n_per_m *
                            deepest_m(touch.speed_m_per_s, touch.deceleration_m_per_s2, late_s, servo_s);
      EXPECT_NEAR(least_guard_n(touch), peak_n / 1.35, 2e-3 * peak_n) << servo_s << ' ' << lag_s;
    }
  }
}

TEST(GuardConfig, AFilterTellsTheTouchLater) {
  FirstTouch touch;
  const double quick_n = least_guard_n(touch);
  touch.filter_s = 0.01;  // √(2 · 0.01 s · 1.2 ms) = 4.9 ms at 50 mm/s on 5 N/mm
  EXPECT_NEAR(least_guard_n(touch) - quick_n, 5000.0 * 0.05 * 4.899e-3 / 1.35, 1e-3);
}

// Of two walls alike the guard begins to brake where it is itself the force: what comes by the lag comes on
// top.
TEST(GuardConfig, AHighGuardIsExceededByWhatComesWithinTheLag) {
  FirstTouch touch{
      .guard_stiffness_n_per_m = 5000.0, .deceleration_m_per_s2 = 1e3, .lag_s = 0.01, .touch_n = 0.0};
  EXPECT_NEAR(least_guard_n(touch), 5000.0 * 0.05 * 0.01 / 0.35, 1e-9);
}

TEST(GuardConfig, ApproachSpeedIsTheFastestThatTheGuardStops) {
  FirstTouch touch;
  EXPECT_EQ(approach_speed(touch, 1e6, 0.25), 0.25);
  const double speed_m_per_s = approach_speed(touch, 5.0, 10.0);
  touch.speed_m_per_s = speed_m_per_s;
  EXPECT_LE(least_guard_n(touch), 5.0);
  touch.speed_m_per_s = 1.001 * speed_m_per_s;
  EXPECT_GT(least_guard_n(touch), 5.0);
}

}  // namespace
}  // namespace longreach::guard_config_test
