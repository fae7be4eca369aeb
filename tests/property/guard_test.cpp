// The force guard at a first touch, through the slave's node and the simulated arm (guard_touch.hpp).
// LONGREACH_FULL: the whole grid of its envelope; without, a sample.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/rendering/guard_touch.hpp"
#include "slave/config/guard_config.hpp"

namespace longreach::test::guard_test {
namespace {

TEST(ForceGuard, HoldsThePeakOfAFirstTouchWhateverTheDelayOfTheLink) {
  double worst = 0.0;
  for (const GuardCase& c : guard_sample()) {
    const GuardTouch touch = guard_touch(c);
    ASSERT_GT(touch.touched_s, 0.0) << c;
    EXPECT_LE(touch.peak_n, kGuardOvershoot * c.guard_n) << c;
    EXPECT_LE(touch.rows.back().force_n, 1.03 * c.guard_n) << c;
    EXPECT_TRUE(touch.view.in_contact) << c;
    EXPECT_EQ(touch.view.limit_violations, 0U) << c;
    worst = std::max(worst, touch.peak_n / c.guard_n);
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("force guard: at most %.2f of the guard over %zu touches\n", worst, guard_sample().size());
}

TEST(ForceGuard, WithoutItTheSameTouchesPressOn) {
  int far = 0;
  for (GuardCase c : guard_sample()) {
    // Where the servo's spring lets the goal press through to more than the guard.
    const double servo_n_per_m = c.mass_kg * std::pow(2.0 * std::numbers::pi * c.servo_hz, 2);
    const double behind_m = std::min(0.02 + c.speed_m_per_s * c.round_trip_s, c.speed_m_per_s * kPressed_s);
    const double both_n_per_m = 1.0 / (1.0 / servo_n_per_m + 1.0 / c.wall_n_per_m);
    if (both_n_per_m * behind_m < 2.0 * c.guard_n) continue;
    c.guarded = false;
    EXPECT_GT(guard_touch(c).peak_n, kGuardOvershoot * c.guard_n) << c;
    ++far;
  }
  EXPECT_GT(2 * far, static_cast<int>(guard_sample().size()));
}

/// A rigid robot, every permitted speed, every wall up to the stiffest one that the guard assumes. In unknown space
/// the slave limits the speed; the limit is not stricter than necessary.
TEST(ForceGuard, HoldsAtEverySpeedAndTheApproachSpeedIsNotStrict) {
  Random random(11);
  const auto spread = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
  double worst = 0.0;
  int limited = 0, touched = 0;
  for (int i = 0; i < campaign(2000, 120); ++i) {
    GuardCase c;
    c.mass_kg = 0.0;
    c.guard_n = spread(5.0, 50.0);
    c.delay_s = 1e-3;
    c.deceleration_m_per_s2 = spread(0.5, 8.0);
    c.servo_hz = spread(3.0, 40.0);
    c.speed_m_per_s = spread(0.025, 0.25);
    c.wall_n_per_m = i % 2 == 0 ? 2e4 : spread(1e3, 2e4);
    c.round_trip_s = 0.3;
    c.seed = static_cast<std::uint64_t>(i) + 1;
    const GuardTouch touch = guard_touch(c);
    EXPECT_LE(touch.peak_n, kGuardOvershoot * c.guard_n) << c;
    EXPECT_EQ(touch.view.limit_violations, 0U) << c;
    worst = std::max(worst, touch.peak_n / c.guard_n);
    touched += touch.touched_s >= 0.0;
    limited += touch.view.approach_m_per_s < c.speed_m_per_s;
  }
  std::printf("approach speed: at most %.2f of the guard, %d of %d touches limited\n", worst, limited,
              touched);
  EXPECT_GT(worst, 1.1);
  EXPECT_GT(limited, campaign(600, 40));
  EXPECT_GT(touched, campaign(1900, 114));
}

/// Any robot that gives way to nothing, any speed, any wall up to the stiffest that the guard reckons with.
TEST(ForceGuard, HoldsWhereverTheRuleAccepts) {
  Random random(7);
  const auto spread = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
  int accepted = 0;
  for (int i = 0; i < campaign(3000, 150); ++i) {
    GuardCase c;
    c.mass_kg = 0.0;
    c.guard_n = spread(2.0, 50.0);
    c.delay_s = 1e-3 * (1.0 + std::floor(random.uniform(0.0, 12.0)));
    c.deceleration_m_per_s2 = spread(0.3, 8.0);
    c.servo_hz = spread(1.5, 40.0);
    c.speed_m_per_s = random.uniform(0.005, 0.05);
    c.wall_n_per_m = spread(1e3, 2e4);
    c.round_trip_s = 0.3;
    c.seed = static_cast<std::uint64_t>(i) + 1;
    const SlaveConfig config = guard_config(c);
    const double jerk_s = 2e-3;  // acceleration over jerk, of guard_config
    const double least_n = least_guard_n({.stiffness_n_per_m = c.wall_n_per_m,
                                          .guard_stiffness_n_per_m = config.command.guard_stiffness_n_per_m,
                                          .speed_m_per_s = c.speed_m_per_s,
                                          .deceleration_m_per_s2 = c.deceleration_m_per_s2,
                                          .lag_s = c.delay_s + jerk_s,
                                          .servo_s = 0.5 / (std::numbers::pi * c.servo_hz),
                                          .touch_n = configured_touch_n(config.sensing),
                                          .filter_s = config.sensing.filter_s});
    const GuardTouch touch = guard_touch(c);
    EXPECT_EQ(touch.view.limit_violations, 0U) << c;
    const bool held = touch.peak_n <= kGuardOvershoot * c.guard_n;
    EXPECT_TRUE(held || c.guard_n < least_n) << c << ": " << touch.peak_n << " N";
    accepted += c.guard_n >= least_n;
  }
  EXPECT_GT(accepted, campaign(900, 45));
}

/// A rigid robot, pressed against the wall up to the guard, a second after the touch.
GuardTouch after(Then then, double wall_n_per_m = 5000.0) {
  GuardCase c;
  c.guard_n = 20.0;
  c.mass_kg = 0.0;
  c.round_trip_s = 0.0;
  c.then = then;
  c.wall_n_per_m = wall_n_per_m;
  return guard_touch(c);
}

TEST(ForceGuard, HoldLowersForceToHalfGuardAndKeepsContact) {
  const GuardTouch touch = after(Then::kSilence);
  EXPECT_EQ(touch.view.state, SafetyState::kHolding);
  const auto pressed = static_cast<std::size_t>(std::lround((touch.touched_s + 1.0) * 1e3));
  ASSERT_NEAR(touch.rows[pressed].force_n, 20.0, 0.5);
  double least_n = 20.0;
  for (std::size_t i = pressed; i < touch.rows.size(); ++i)
    least_n = std::min(least_n, touch.rows[i].force_n);
  EXPECT_GT(least_n, 9.5);
  EXPECT_NEAR(touch.rows.back().force_n, 10.0, 0.5);
  EXPECT_TRUE(touch.view.in_contact);
  EXPECT_EQ(touch.view.touch, 1U);
  EXPECT_EQ(touch.view.limit_violations, 0U);
}

/// Whether the stiffness is known by then or not, and whether the robot gives way, too.
TEST(ForceGuard, HoldReachesItsLimitInOneSecondAndKeepsContact) {
  constexpr double kGap_s = 0.156;   // until the hold begins
  constexpr double kBounce_s = 0.3;  // of a light tool at a first touch
  int bled = 0;
  double swift = 0.0;
  for (const double wall_n_per_m : {500.0, 2000.0, 5000.0, 2e4}) {
    for (const double mass_kg : {0.0, 1.0, 10.0}) {
      for (const double servo_hz : {3.0, 10.0}) {
        if (mass_kg == 1.0 && servo_hz == 3.0) continue;  // 0.4 N/mm: it bounces at a touch
        for (const double then_s : {0.0, 1.0}) {
          GuardCase c;
          c.wall_n_per_m = wall_n_per_m;
          c.mass_kg = mass_kg;
          c.servo_hz = servo_hz;
          c.then_s = then_s;
          c.then = Then::kSilence;
          const GuardTouch touch = guard_touch(c);
          const double limit_n = 0.5 * c.guard_n, held_s = touch.touched_s + then_s + kGap_s;
          double least_n = 1e9, most_n = 0.0, before_n = 0.0;
          for (const GuardRow& row : touch.rows) {
            if (row.t_s <= held_s) before_n = row.force_n;
            if (row.t_s > held_s + kBounce_s) least_n = std::min(least_n, row.force_n);
            if (row.t_s > held_s + 1.0) most_n = std::max(most_n, row.force_n);
          }
          bled += before_n > limit_n;
          swift = std::max(swift, most_n / limit_n);
          EXPECT_EQ(touch.view.state, SafetyState::kHolding) << c << ' ' << then_s;
          EXPECT_LE(most_n, limit_n) << c << ' ' << then_s;
          EXPECT_GE(least_n, 0.5 * std::min(limit_n, before_n)) << c << ' ' << then_s;
          EXPECT_GT(least_n, 0.3) << c << ' ' << then_s;  // touched all the time
          EXPECT_TRUE(touch.view.in_contact) << c << ' ' << then_s;
          EXPECT_EQ(touch.view.limit_violations, 0U) << c << ' ' << then_s;
        }
      }
    }
  }
  std::printf("holds: %d of 40 touches had to come down, to at most %.2f of the limit\n", bled, swift);
  EXPECT_GT(bled, 20);
}

TEST(ForceGuard, AHoldWithLessForceThanThatDoesNotMoveTheTool) {
  const GuardTouch touch = after(Then::kSilence, 400.0);
  EXPECT_EQ(touch.view.state, SafetyState::kHolding);
  const auto held = static_cast<std::size_t>(std::lround((touch.touched_s + 1.5) * 1e3));
  EXPECT_NEAR(touch.rows[held].force_n, 8.0, 0.5);
  EXPECT_NEAR(touch.rows.back().tool_m, touch.rows[held].tool_m, 1e-6);
}

TEST(ForceGuard, AStoppedRobotStaysWhereItIs) {
  const GuardTouch touch = after(Then::kStop);
  EXPECT_EQ(touch.view.state, SafetyState::kStopped);
  const auto stopped = static_cast<std::size_t>(std::lround((touch.touched_s + 1.5) * 1e3));
  EXPECT_NEAR(touch.rows[stopped].force_n, 20.0, 0.5);
  EXPECT_NEAR(touch.rows.back().tool_m, touch.rows[stopped].tool_m, 1e-6);
}

}  // namespace
}  // namespace longreach::test::guard_test
