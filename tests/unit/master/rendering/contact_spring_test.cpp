#include "master/rendering/contact_spring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/random.hpp"

namespace longreach::contact_spring_test {
namespace {

constexpr double kTick_s = 0.001;

/// A spring with a tank of its own.
struct Spring : ContactSpring {
  explicit Spring(const ContactSpringConfig& config) : ContactSpring(config) {}
  double step(double s_m, double dt_s) { return ContactSpring::step(s_m, dt_s, EnergySource(tank)); }
  EnergyTank tank{0.02};
};

TEST(ContactSpring, PushesWithStiffnessTimesDepthBehindTheSurface) {
  Spring spring({});
  spring.begin(-0.01, 0.0);
  ASSERT_TRUE(spring.set_stiffness(-0.01, 1000.0));
  EXPECT_EQ(spring.step(-0.01, kTick_s), 0.0);
  EXPECT_NEAR(spring.step(0.002, kTick_s), 2.0, 1e-12);
  EXPECT_NEAR(spring.energy_j(0.002), 0.5 * 1000.0 * 0.002 * 0.002, 1e-15);
}

TEST(ContactSpring, BeginsAtZeroForceWhenTheHandIsAlreadyDeep) {
  Spring spring({});
  spring.begin(0.012, 0.0);
  spring.set_stiffness(0.012, 5000.0);
  EXPECT_EQ(spring.step(0.012, kTick_s), 0.0);
  EXPECT_EQ(spring.energy_j(0.012), 0.0);
}

TEST(ContactSpring, ReturnsToTheSurfaceForFreeWhenTheHandRetreats) {
  Spring spring({});
  spring.begin(0.012, 0.0);
  spring.set_stiffness(0.012, 5000.0);
  for (double s = 0.012; s > -0.001; s -= 1e-5) EXPECT_LT(spring.step(s, kTick_s), 1e-9);
  EXPECT_NEAR(spring.anchor_m(), 0.0, 1e-12);
  EXPECT_NEAR(spring.step(0.001, kTick_s), 5.0, 1e-9);
}

// 40 mm of retreat before a wall that was learnt late: it gives back what loaded it, and no more.
TEST(ContactSpring, FarBehindAHandThatRetreatsIsFeltForWhatLoadedItAlone) {
  Spring spring({});
  double s = 0.04, given_j = 0.0;
  spring.begin(s, 0.0);
  spring.set_stiffness(s, 500.0);
  spring.tank.fill(0.01);
  for (int i = 0; i < 1000; ++i) spring.step(s, kTick_s);
  EXPECT_NEAR(spring.energy_j(s), 0.01, 1e-6) << "it grows under a hand that rests";
  double felt_s = 0.0;
  while (s > 0.0) {
    const double force_n = spring.step(s, kTick_s);
    felt_s += force_n > 0.2 ? kTick_s : 0.0;
    given_j += force_n * 2e-5;
    s -= 2e-5;
  }
  EXPECT_LT(felt_s, 0.4) << "of 2 s";
  EXPECT_NEAR(given_j, 0.01, 2e-4);
  for (int i = 0; i < 100; ++i) spring.step(s += 2e-5, kTick_s);
  EXPECT_NEAR(spring.force_n(s), 500.0 * s, 0.02) << "and then it is where it was registered";
}

TEST(ContactSpring, LoadsUnderAHandThatRestsByARamp) {
  EnergyTank tank(0.02), store(0.02);
  store.fill(0.02);
  ContactSpring spring({});
  spring.begin(0.004, 0.0);
  spring.set_stiffness(0.004, 1000.0);
  double last_n = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double force_n = spring.step(0.004, kTick_s, EnergySource(tank, &store));
    EXPECT_LE(force_n - last_n, 15.0 * kTick_s / 2.0);
    if (i == 300) {
      EXPECT_GT(force_n, 1.8);
    }
    last_n = force_n;
  }
  EXPECT_GT(last_n, 0.97 * 4.0);
  EXPECT_NEAR(store.level_j(), 0.02 - spring.energy_j(0.004), 1e-9);
}

TEST(ContactSpring, PaysFromTheTankBeforeTheStore) {
  EnergyTank tank(0.02), store(0.02);
  tank.fill(0.001);
  store.fill(0.02);
  ContactSpring spring({});
  spring.begin(0.002, 0.0);
  spring.set_stiffness(0.002, 1000.0);
  for (int i = 0; i < 2000; ++i) spring.step(0.002, kTick_s, EnergySource(tank, &store));
  EXPECT_EQ(tank.level_j(), 0.0);
  EXPECT_NEAR(store.level_j(), 0.019, 1e-4);
}

// A hand that rests trembles by a count of the encoders: once loaded, nothing is loaded again.
TEST(ContactSpring, DoesNotRatchetWithinTwoCounts) {
  constexpr double kCount = 2e-5;
  EnergyTank tank(0.02), store(0.02);
  store.fill(0.02);
  ContactSpring spring({.count_m = kCount});
  spring.begin(0.002, 0.0);
  spring.set_stiffness(0.002, 1000.0);
  for (int i = 0; i < 2000; ++i) spring.step(0.002, kTick_s, EnergySource(tank, &store));
  const double loaded_j = store.level_j();
  for (int i = 0; i < 5000; ++i) spring.step(0.002 + (i % 2) * kCount, kTick_s, EnergySource(tank, &store));
  EXPECT_EQ(store.level_j(), loaded_j);
  for (int i = 0; i < 2000; ++i) spring.step(0.003, kTick_s, EnergySource(tank, &store));
  EXPECT_NEAR(spring.force_n(0.003), 3.0, 1000.0 * 2.0 * kCount);
}

TEST(ContactSpring, StiffnessIncreaseCausesNoForceStep) {
  Spring spring({});
  spring.begin(-0.001, 0.0);
  spring.set_stiffness(-0.001, 500.0);
  const double s = 0.004;
  const double before_n = spring.step(s, kTick_s);
  const double before_j = spring.energy_j(s);
  spring.set_stiffness(s, 5000.0);
  EXPECT_NEAR(spring.force_n(s), before_n, 1e-12);
  EXPECT_LT(spring.energy_j(s), before_j);
}

TEST(ContactSpring, EasesToALowerStiffnessWithItsTimeConstant) {
  Spring spring({.fade_s = 0.2});
  spring.begin(-0.001, 0.0);
  spring.set_stiffness(-0.001, 4000.0);
  const double s = 0.001;
  const double before_n = spring.step(s, kTick_s);
  spring.set_stiffness(s, 1000.0);
  EXPECT_NEAR(spring.force_n(s), before_n, 1e-12);
  for (int i = 0; i < 200; ++i) spring.step(s, kTick_s);
  EXPECT_NEAR(spring.stiffness_n_per_m(), 1000.0 + 3000.0 * std::exp(-1.0), 1.0);
}

TEST(ContactSpring, YieldsAtTheForceLimit) {
  Spring spring({.force_max_n = 10.0});
  spring.begin(-0.001, 0.0);
  spring.set_stiffness(-0.001, 5000.0);
  EXPECT_NEAR(spring.step(0.05, kTick_s), 10.0, 1e-9);
  EXPECT_TRUE(spring.yielding());
}

TEST(ContactSpring, PaysForAnOutwardAnchorFromTheTankExactly) {
  Spring spring({});
  spring.begin(0.010, 0.0);  // deep at first touch: the anchor wants to come back by 10 mm
  spring.set_stiffness(0.010, 1000.0);
  const double s = 0.012;
  spring.step(s, kTick_s);
  EXPECT_EQ(spring.tank.fill(0.005), 0.0);
  double springs_j = spring.energy_j(s);
  for (int i = 0; i < 1000; ++i) {
    spring.step(s, kTick_s);
    EXPECT_NEAR(spring.energy_j(s) - springs_j, spring.paid_j(), 1e-15);
    springs_j = spring.energy_j(s);
  }
  EXPECT_NEAR(springs_j, 0.5 * 1000.0 * 0.002 * 0.002 + 0.005, 1e-6);
  EXPECT_GE(spring.tank.level_j(), 0.0);
}

TEST(EnergyTank, NamesWhatItCouldNotTakeOrPayAndSpendsOnlyWhatIsThere) {
  EnergyTank tank(0.02);
  EXPECT_NEAR(tank.fill(0.05), 0.03, 1e-15);
  EXPECT_NEAR(tank.spend(0.005), 0.005, 1e-15);
  EXPECT_EQ(tank.spend(-1.0), 0.0);
  EXPECT_NEAR(tank.fill(-0.05), -0.035, 1e-15);
  EXPECT_EQ(tank.spend(1.0), 0.0);
  tank.fill(0.02);
  tank.resize(0.01);
  EXPECT_NEAR(tank.level_j(), 0.01, 1e-15);
}

TEST(ContactSpring, RefusesWhatIsNotFinite) {
  Spring spring({});
  spring.begin(-0.001, 0.0);
  spring.set_stiffness(-0.001, 1000.0);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    EXPECT_FALSE(spring.set_stiffness(0.001, bad));
    EXPECT_FALSE(spring.set_surface(bad));
  }
  EXPECT_NEAR(spring.step(0.001, kTick_s), 1.0, 1e-12);
}

/// The law: with the hand still or moving, an update or a tick never raises energy but by the work of the
/// hand and what the tank paid; force never steps up at an update.
TEST(ContactSpring, NeverGainsEnergyFromAnySequenceOfUpdates) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    Spring spring({});
    double s = -0.002;
    spring.begin(s, 0.0);
    for (int i = 0; i < 4000; ++i) {
      if (random.chance(0.3)) {
        const double before_n = spring.force_n(s);
        const double before_j = spring.energy_j(s);
        const double k =
            random.chance(0.2) ? (random.chance(0.5) ? 0.0 : 1e9) : std::exp(random.uniform(-20.0, 20.0));
        spring.set_stiffness(s, random.chance(0.05) ? -k : k);
        ASSERT_NEAR(spring.force_n(s), before_n, 1e-9 + 1e-9 * before_n) << "seed " << seed << " tick " << i;
        ASSERT_LE(spring.energy_j(s), before_j + 1e-12) << "seed " << seed << " tick " << i;
      }
      if (random.chance(0.1)) spring.set_surface(random.uniform(-0.01, 0.01));
      if (random.chance(0.1)) spring.tank.fill(random.uniform(-0.001, 0.001));
      const double before_j = spring.energy_j(s);
      spring.step(s, kTick_s);
      ASSERT_LE(spring.energy_j(s), before_j + spring.paid_j() + 1e-12) << "seed " << seed << " tick " << i;
      ASSERT_LE(spring.force_n(s), 15.0 + 1e-9);
      ASSERT_TRUE(std::isfinite(spring.anchor_m()));
      s = std::clamp(s + random.uniform(-2e-4, 2e-4), -0.01, 0.01);
    }
  }
}

}  // namespace
}  // namespace longreach::contact_spring_test
