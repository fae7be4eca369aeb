// What the experiments with the haptic devices say, against closed forms and exact models.

#include <gtest/gtest.h>

#include <map>

#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach::devices_test {
namespace {

std::map<std::string, double> metrics(std::string_view name) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> values;
  for (const Metric& m : find_experiment(name)->run(run)) values[m.name] = m.value;
  return values;
}

TEST(HomeRotation, MatchesClosedFormForLightAndCriticalDamping) {
  auto m = metrics("home-rotation");
  EXPECT_NEAR(m.at("zeta_at_0.5"), 0.31, 0.01);
  EXPECT_NEAR(m.at("zeta_at_1.6"), 1.0, 0.01);
  EXPECT_GT(m.at("overshoot_at_0.5"), 0.3);
  EXPECT_LT(m.at("overshoot_at_1.6"), 1e-6);
  EXPECT_LE(m.at("settling_difference_max"), 0.05);
}

TEST(HomeTranslation, SettlesAsTheClosedFormAndEndsNearHomeWithFriction) {
  auto m = metrics("home-translation");
  EXPECT_LE(m.at("settling_difference_max"), 0.05);
  EXPECT_GT(m.at("overshoot_at_zeta_0.3"), 0.3);
  EXPECT_LT(m.at("overshoot_at_zeta_1"), 1e-6);
  EXPECT_LT(m.at("left_on_spring"), 1e-3);
  EXPECT_LT(m.at("left_gliding"), 2e-3);
}

TEST(WallRotation, SharesTheWayBetweenHandAndWallAndDoesNotTremble) {
  auto m = metrics("wall-rotation");
  for (const char* at : {"_at_8", "_at_20", "_at_50"}) {
    EXPECT_NEAR(m.at(std::string("depth") + at), m.at(std::string("depth_expected") + at), 0.1);
    EXPECT_LT(m.at(std::string("trembling") + at), 0.02);
  }
}

TEST(Gravity, IsCarriedEverywhereAndTheRealDeviceStaysWhereItIsLeft) {
  auto m = metrics("gravity");
  EXPECT_LT(m.at("drift_ideal_max"), 1e-4);
  EXPECT_LT(m.at("drift_real_max"), 1e-4);
  EXPECT_GT(m.at("drift_without_compensation"), 0.01);
  for (const char* leg : {"home_1", "home_2", "home_3", "raised_1", "raised_2", "raised_3"})
    EXPECT_NEAR(m.at(std::string("torque_") + leg) / m.at(std::string("torque_paper_") + leg), 1.0, 0.07);
}

TEST(WallTranslation, IsStableUpToTheExactLimitAndPassiveWhereTheLineSaysSo) {
  auto m = metrics("wall-translation");
  EXPECT_LE(m.at("limit_difference_max"), 0.10);
  for (const char* grip : {"light", "firm", "released"})
    EXPECT_EQ(m.at(std::string("paper_wall_stable_") + grip), 1.0) << grip;
  EXPECT_LT(m.at("cycle_energy_at_50_percent_of_passive_damping"), 0.0);
  EXPECT_LT(m.at("cycle_energy_at_90_percent_of_passive_damping"), 0.0);
  EXPECT_GT(m.at("cycle_energy_at_110_percent_of_passive_damping"), 0.0);
  EXPECT_GT(m.at("cycle_energy_at_200_percent_of_passive_damping"), 0.0);
}

TEST(SampledWall, HasTheLimitsThatAreKnownInClosedForm) {
  // A free mass: 2 (b + B)/T in the limit of little damping; with one sample of delay (b + B)/(1.5 T).
  SampledWall wall{.mass_kg = 1.0, .device_n_s_per_m = 0.5, .wall_n_s_per_m = 0.0, .period_s = 1e-3};
  EXPECT_NEAR(exact_limit_n_per_m(wall) / 1000.0, 1.0, 1e-3);
  wall.delay_samples = 1;
  EXPECT_NEAR(exact_limit_n_per_m(wall) / 333.3, 1.0, 1e-2);
  // Negative damping is never stable; a wall without stiffness or damping always.
  wall.device_n_s_per_m = -1.0;
  EXPECT_LT(exact_limit_n_per_m(wall), 1e-9);
  wall.device_n_s_per_m = 0.5;
  EXPECT_LE(spectral_radius(wall, 0.0), 1.0);
}

}  // namespace
}  // namespace longreach::devices_test
