// The comparison laws against one step that was computed by hand. T = 1 ms.
#include "deploy/lab/comparison/comparison_law.hpp"

#include <gtest/gtest.h>

namespace longreach::comparison_law_test {
namespace {

constexpr double kT_s = 1e-3;

Vector3 along(double x) { return {x, 0.0, 0.0}; }

TEST(DirectLaw, PlaysBackWhatTheSlaveMeasuredAndHoldsItInSilence) {
  DirectLaw law;
  EXPECT_EQ(law.step({.position_m = along(0.1)}, kT_s).force_n, Vector3::Zero());
  const ComparisonReport report{.force_n = {-3.0, 0.5, 0.0}};
  const ComparisonOutput out = law.step({.position_m = along(0.1), .report = report}, kT_s);
  EXPECT_EQ(out.force_n, report.force_n);
  EXPECT_EQ(out.command.position_m, along(0.1));
  EXPECT_EQ(law.step({}, kT_s).force_n, report.force_n);
}

TEST(PositionPositionLaw, IsASpringToTheFarPositionAndADamper) {
  PositionPositionLaw law({.coupling_n_per_m = 100.0, .coupling_n_s_per_m = 10.0});
  EXPECT_EQ(law.step({.position_m = along(0.02), .velocity_m_per_s = along(0.1)}, kT_s).force_n,
            Vector3::Zero());
  const ComparisonOutput out = law.step({.position_m = along(0.02),
                                         .velocity_m_per_s = along(0.1),
                                         .report = ComparisonReport{.position_m = along(0.015)}},
                                        kT_s);
  EXPECT_NEAR(out.force_n.x(), -1.5, 1e-12);
}

TEST(WaveLaw, ScattersByTheEquations) {
  WaveLaw law({.wave_n_s_per_m = 10.0});
  const ComparisonOutput out =
      law.step({.velocity_m_per_s = along(0.1), .report = ComparisonReport{.wave = along(0.2)}}, kT_s);
  EXPECT_NEAR(out.force_n.x(), 0.2 * 4.47213595 - 1.0, 1e-8);
  EXPECT_NEAR(out.command.wave.x(), 0.447213595 - 0.2, 1e-8);
  // What the hand puts in is what the waves carry away.
  EXPECT_NEAR(-out.force_n.x() * 0.1, 0.5 * (out.command.wave.squaredNorm() - 0.04), 1e-12);
}

TEST(WaveLaw, TakesALostWaveForNone) {
  WaveLaw law({.wave_n_s_per_m = 10.0});
  law.step({.report = ComparisonReport{.wave = along(0.2)}}, kT_s);
  EXPECT_NEAR(law.step({.velocity_m_per_s = along(0.1)}, kT_s).force_n.x(), -1.0, 1e-12);
}

TEST(PassivityLaw, DampsAwayWhatDidNotEnterAtTheSlave) {
  PassivityLaw law({.handle_mass_kg = 0.2});
  // 2 N at 0.5 m/s give 1 mJ; 0.4 mJ have entered: 0.6 mJ are damped away by 2.4 N s/m.
  const ComparisonInput in{.velocity_m_per_s = along(0.5),
                           .report = ComparisonReport{.force_n = along(2.0), .energy_j = 4e-4}};
  EXPECT_NEAR(law.step(in, kT_s).force_n.x(), 0.8, 1e-12);
  EXPECT_NEAR(law.left_j(), 4e-4, 1e-15);
}

TEST(PassivityLaw, DampsByTwiceTheMassOverASampleAtMost) {
  PassivityLaw law({.handle_mass_kg = 5e-4});
  const ComparisonInput in{.velocity_m_per_s = along(0.5),
                           .report = ComparisonReport{.force_n = along(2.0), .energy_j = 4e-4}};
  EXPECT_NEAR(law.step(in, kT_s).force_n.x(), 1.5, 1e-12);
  EXPECT_NEAR(law.left_j(), 7.5e-4, 1e-15);
}

TEST(PassivityLaw, TellsTheSlaveWhatEnteredHereAndDampsNothingOfIt) {
  PassivityLaw law({});
  const ComparisonInput in{.velocity_m_per_s = along(-0.5),
                           .report = ComparisonReport{.force_n = along(2.0)}};
  const ComparisonOutput out = law.step(in, kT_s);
  EXPECT_EQ(out.force_n.x(), 2.0);
  EXPECT_NEAR(out.command.energy_j, 1e-3, 1e-15);
}

TEST(TankLaw, CutsTheForceWhenTheTankIsEmptyAndFillsItByDamping) {
  const ComparisonConfig config{.tank_level_j = 0.05, .tank_n_s_per_m_per_j = 400.0, .tank_share_per_s = 0.0};
  TankLaw law(config);
  const ComparisonReport report{.force_n = along(2.0)};
  EXPECT_NEAR(law.step({.velocity_m_per_s = along(0.1), .report = report}, kT_s).force_n.x(), -2.0, 1e-12);
  // 2 N over 0.1 mm: 0.2 mJ, 4 % of the tenth of the level from which on the force is whole.
  EXPECT_NEAR(law.step({.velocity_m_per_s = along(0.1)}, kT_s).force_n.x(), 0.08 - 400.0 * 0.0498 * 0.1,
              1e-12);
  EXPECT_NEAR(law.level_j(), 2e-4, 1e-15);
}

TEST(TankLaw, SharesItsEnergyAndTakesWhatArrives) {
  TankLaw law({.tank_share_per_s = 100.0});
  const ComparisonOutput out = law.step({.report = ComparisonReport{.energy_j = 0.02}}, kT_s);
  EXPECT_NEAR(out.command.energy_j, 0.002, 1e-15);
  EXPECT_NEAR(law.level_j(), 0.018, 1e-15);
  // The same total again is no new energy.
  EXPECT_NEAR(law.step({.report = ComparisonReport{.energy_j = 0.02}}, kT_s).command.energy_j, 0.0038, 1e-15);
}

TEST(ComparisonLaw, IsSelectedByName) {
  const auto kind = [](RenderingLaw law) { return make_comparison_law(law, {}).index(); };
  EXPECT_EQ(kind(RenderingLaw::kDirect), 0U);
  EXPECT_EQ(kind(RenderingLaw::kPositionPosition), 1U);
  EXPECT_EQ(kind(RenderingLaw::kWave), 2U);
  EXPECT_EQ(kind(RenderingLaw::kTdpa), 3U);
  EXPECT_EQ(kind(RenderingLaw::kTank), 4U);
  EXPECT_FALSE(is_comparison(RenderingLaw::kStiffness));
  EXPECT_FALSE(is_comparison(RenderingLaw::kNaive));
  EXPECT_TRUE(is_comparison(RenderingLaw::kDirect));
}

}  // namespace
}  // namespace longreach::comparison_law_test
