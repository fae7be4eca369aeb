// The slave's ends of the comparison laws against steps that were computed by hand. T = 1 ms.
#include "deploy/lab/comparison/coupling.hpp"

#include <gtest/gtest.h>

namespace longreach::coupling_test {
namespace {

constexpr double kT_s = 1e-3;

Vector3 along(double x) { return {x, 0.0, 0.0}; }

CouplingInput input(const ComparisonCommand& command, double force_n) {
  return {.command = command, .force_n = along(force_n)};
}

TEST(FollowCoupling, GoesWhereTheHandleWasAndReportsTheForce) {
  FollowCoupling coupling;
  const CouplingOutput out = coupling.step(input({.position_m = along(0.03)}, -2.0), kT_s);
  EXPECT_EQ(out.setpoint_m, along(0.03));
  EXPECT_EQ(out.report.force_n, along(-2.0));
  EXPECT_EQ(coupling.step({}, kT_s).setpoint_m, along(0.03));
}

TEST(SpringCoupling, IsAnAdmittanceOnASpring) {
  SpringCoupling coupling({.coupling_n_per_m = 100.0, .slave_mass_kg = 0.5, .slave_n_s_per_m = 10.0});
  const CouplingOutput out = coupling.step(input({.position_m = along(0.01)}, -0.4), kT_s);
  EXPECT_NEAR(out.setpoint_m.x(), 1e-6 * 0.6 / 0.51, 1e-18);
}

TEST(WaveCoupling, IsTheMirrorImage) {
  WaveCoupling coupling({.wave_n_s_per_m = 10.0, .slave_mass_kg = 0.5, .slave_n_s_per_m = 10.0});
  const CouplingOutput out = coupling.step(input({.wave = along(0.5)}, -1.0), kT_s);
  const double v = 1e-3 * (0.5 * 4.472135955 - 1.0) / 0.52;
  EXPECT_NEAR(out.setpoint_m.x(), 1e-3 * v, 1e-14);
  EXPECT_NEAR(out.report.wave.x(), 4.472135955 * v - 0.5, 1e-10);
}

TEST(PaidStep, TakesAwayOnlyWhatIsNotPaidForAndOnlyAlongTheForce) {
  const Vector3 force_n = along(-2.0), step_m(1e-3, 5e-3, 0.0);
  EXPECT_EQ(paid_step(step_m, force_n, 2.1e-3), step_m);
  EXPECT_NEAR((paid_step(step_m, force_n, 5e-4) - Vector3(2.5e-4, 5e-3, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((paid_step(step_m, force_n, -1.0) - Vector3(0.0, 5e-3, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(paid_step(step_m, Vector3::Zero(), -1.0), step_m);
  EXPECT_EQ(paid_step(-step_m, force_n, -1.0), -step_m);
}

TEST(PassivityCoupling, PressesWithinMasterEnergyAndCatchesUp) {
  PassivityCoupling coupling({.slave_speed_max_m_per_s = 0.5});
  ComparisonCommand command{.position_m = along(5e-4), .energy_j = 4e-4};
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 2e-4, 1e-15);
  // Spent: it stays.
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 2e-4, 1e-15);
  EXPECT_NEAR(coupling.left_j(), 4e-4, 1e-15);
  command.energy_j = 8e-4;
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 4e-4, 1e-15);
  // Backwards the wall pays, and the master is told.
  command.position_m = along(0.0);
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 0.0, 1e-15);
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).report.energy_j, 8e-4, 1e-15);
}

TEST(TankCoupling, PressesAsFarAsItsTankPays) {
  TankCoupling coupling({.slave_speed_max_m_per_s = 0.5, .tank_share_per_s = 0.0});
  const ComparisonCommand command{.position_m = along(5e-4), .energy_j = 4e-4};
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 2e-4, 1e-15);
  EXPECT_NEAR(coupling.step(input(command, -2.0), kT_s).setpoint_m.x(), 2e-4, 1e-15);
  EXPECT_NEAR(coupling.level_j(), 0.0, 1e-15);
}

}  // namespace
}  // namespace longreach::coupling_test
