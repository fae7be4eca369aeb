// The last stage before the motors, rule by rule.

#include "master/rendering/port_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace longreach::port_guard_test {
namespace {

constexpr double kTick_s = 1e-3;

PortGuard opened(const PortGuardConfig& config = {}) {
  PortGuard guard(config);
  guard.open();
  return guard;
}

TEST(PortGuard, LetsThroughWhatIsWithinItsLimits) {
  PortGuard guard = opened();
  const Vector3 F(1.0, -2.0, 3.0);
  EXPECT_EQ(guard.apply({F, Vector3::Zero(), Vector3(0.1, 0.0, 0.0), true}, kTick_s), F);
  EXPECT_FALSE(guard.clamped());
  EXPECT_FALSE(guard.injecting());
}

TEST(PortGuard, NothingThatIsNotFiniteReachesAMotor) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      PortForce force{Vector3::Ones(), Vector3::Ones(), Vector3::Zero(), true};
      (i == 0 ? force.rendered : i == 1 ? force.always : force.rate)[i] = bad;
      PortGuard guard = opened();
      EXPECT_TRUE(guard.apply(force, kTick_s).allFinite());
      EXPECT_EQ(guard.apply({Vector3::Ones(), Vector3::Zero(), Vector3::Zero(), true}, kTick_s),
                Vector3::Ones());
    }
  }
}

TEST(PortGuard, LimitsTheForceInItsDirection) {
  PortGuard guard = opened({.force_max = 10.0, .slew_per_s = 1e9});
  const Vector3 F = guard.apply({Vector3(30.0, 40.0, 0.0), Vector3::Zero(), Vector3::Zero(), true}, kTick_s);
  EXPECT_NEAR((F - Vector3(6.0, 8.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(guard.clamped());
}

TEST(PortGuard, LimitsTheRiseOfTheForceAndNotItsFall) {
  PortGuard guard = opened({.slew_per_s = 500.0});
  const PortForce pushed{Vector3(4.0, 0.0, 0.0), Vector3::Zero(), Vector3::Zero(), true};
  EXPECT_NEAR(guard.apply(pushed, kTick_s).x(), 0.5, 1e-12);
  EXPECT_NEAR(guard.apply(pushed, kTick_s).x(), 1.0, 1e-12);
  EXPECT_EQ(guard.apply({Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), true}, kTick_s), Vector3::Zero());
}

TEST(PortGuard, RampsToZeroWhenDisengagedExceptConstantForces) {
  PortGuard guard = opened({.ramp_s = 0.05});
  const Vector3 gravity(0.0, 0.0, 1.0);
  PortForce force{Vector3(10.0, 0.0, 0.0), gravity, Vector3::Zero(), true};
  guard.apply(force, kTick_s);
  guard.apply(force, kTick_s);
  force.live = false;
  for (int i = 1; i <= 50; ++i) {
    const Vector3 F = guard.apply(force, kTick_s);
    EXPECT_NEAR(F.x(), 10.0 * (1.0 - i / 50.0), 1e-9) << i;
    EXPECT_NEAR(F.z(), 1.0, 1e-12);
  }
}

// E_port += -f[k-1] . (x[k] - x[k-1])
TEST(PortGuard, SumsTheEnergyThatTheHandPutsIn) {
  PortGuard guard = opened();
  EXPECT_EQ(guard.observe(Vector3(0.01, 0.0, 0.0)), 0.0) << "no force yet";
  guard.apply({Vector3(2.0, 0.0, -1.0), Vector3::Zero(), Vector3::Zero(), true}, kTick_s);
  EXPECT_NEAR(guard.observe(Vector3(-0.001, 5.0, 0.0)), 0.002, 1e-15);
  EXPECT_NEAR(guard.observe(Vector3(0.0, 0.0, -0.003)), -0.003, 1e-15);
  EXPECT_NEAR(guard.port_energy_j(), -0.001, 1e-15);
  guard.open();
  EXPECT_NEAR(guard.observe(Vector3::Ones()), -1.0, 1e-15) << "the motors still exert the force";
  EXPECT_NEAR(guard.port_energy_j(), -1.001, 1e-15);
}

TEST(PortGuard, DampsNoHandThatRestsNorOneThatNothingIsRenderedTo) {
  const Vector3 rate(0.1, 0.0, 0.0);
  PortGuard guard = opened();
  guard.owe(1e-4);
  EXPECT_EQ(guard.apply({Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), true}, kTick_s), Vector3::Zero());
  EXPECT_FALSE(guard.injecting());
  PortGuard closed{PortGuardConfig{}};
  closed.owe(1e-4);
  EXPECT_EQ(closed.apply({Vector3::Zero(), Vector3::Zero(), rate, true}, kTick_s), Vector3::Zero());
  EXPECT_FALSE(closed.injecting());
  closed.open();
  EXPECT_EQ(closed.apply({Vector3::Zero(), Vector3::Zero(), rate, true}, kTick_s), Vector3::Zero())
      << "what was owed before is forgotten";
  EXPECT_EQ(closed.deficit_max_j(), 1e-4);
}

TEST(PortGuard, TakesBackByDampingWhatLeakedAndNoMoreThanASampleBears) {
  const PortGuardConfig config{.handle_mass = 0.2, .slew_per_s = 1e9};
  const Vector3 rate(0.1, 0.0, 0.0);
  PortGuard guard = opened(config);
  guard.owe(1e-4);
  // Owed over v² dt: 1e-4 / 1e-5 = 10 N s/m.
  EXPECT_NEAR(guard.apply({Vector3::Zero(), Vector3::Zero(), rate, true}, kTick_s).x(), -1.0, 1e-9);
  EXPECT_TRUE(guard.injecting());
  guard.owe(1.0);
  EXPECT_NEAR(guard.apply({Vector3::Zero(), Vector3::Zero(), rate, true}, kTick_s).x(),
              -0.4 * 0.2 / kTick_s * 0.1, 1e-9);
  EXPECT_EQ(guard.repay(2.0), 2.0 - 1.0001);
  EXPECT_EQ(guard.apply({Vector3::Zero(), Vector3::Zero(), rate, true}, kTick_s), Vector3::Zero());
}

// A handle whose reading leaps is a swift one.
TEST(PortGuard, WhatItTakesBackRisesNoFasterThanAnyForce) {
  PortGuard guard = opened({.slew_per_s = 5000.0});
  const PortForce leaps{Vector3::Zero(), Vector3::Zero(), Vector3(300.0, 0.0, 0.0), true};
  guard.owe(1.0);
  EXPECT_NEAR(guard.apply(leaps, kTick_s).x(), -3.333333, 1e-6);  // 1 J over 300 m/s and a tick
  guard.owe(1e3);
  EXPECT_NEAR(guard.apply(leaps, kTick_s).x(), -8.333333, 1e-6);
  EXPECT_TRUE(guard.injecting());
  EXPECT_TRUE(guard.clamped());
}

// A freed hand moves, so that its damping is a force of several newton.
TEST(PortGuard, TheDampingOfAFreedHandBeginsAndEndsByARampAlsoInAnEngagement) {
  const Vector3 fast(0.2, 0.0, 0.0);
  PortGuard guard = opened({.freed_damping = 30.0});
  guard.free_hand();
  double before_n = 0.0, largest_n = 0.0, most_n = 0.0;
  for (int i = 0; i < 1000; ++i) {
    if (i == 100) guard.open();
    const double now_n = -guard.apply({Vector3::Zero(), Vector3::Zero(), fast, i >= 100}, kTick_s).x();
    largest_n = std::fmax(largest_n, std::abs(now_n - before_n));
    most_n = std::fmax(most_n, now_n);
    before_n = now_n;
  }
  EXPECT_NEAR(most_n, 30.0 * 0.2, 1e-9);
  EXPECT_LE(largest_n, 0.3 + 1e-9);
  EXPECT_EQ(before_n, 0.0) << "it ends";
}

}  // namespace
}  // namespace longreach::port_guard_test
