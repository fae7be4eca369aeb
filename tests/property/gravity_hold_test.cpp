// A DELTA whose motors carry its weight stays anywhere: no friction, ideal sensors and motors, ten virtual
// seconds. LONGREACH_FULL: 1e5 poses.

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "master/devices/delta/delta_handle.hpp"
#include "master/simulation/simulated_delta.hpp"

namespace longreach::gravity_hold_test {
namespace {

DeviceConfig ideal() {
  DeviceConfig config;
  config.delta.drive.viscous_nm_s_per_rad = 0.0;
  config.delta.drive.coulomb_nm = 0.0;
  config.delta.drive.resolution_rad = 0.0;
  config.delta.drive.bandwidth_hz = 0.0;
  return config;
}

Vector3 in_unit_ball(Random& random) {
  for (;;) {
    const Vector3 v(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    if (v.norm() <= 1.0) return v;
  }
}

double drift_m(const DeviceConfig& config, const Vector3& at_m) {
  constexpr double kSample_s = 4e-3;
  SimulatedDelta device(config);
  DeltaHandle handle(config);
  EXPECT_TRUE(device.place(at_m));
  double worst_m = 0.0;
  for (double t = 0.0; t < 10.0; t += kSample_s) {
    handle.read(device.encoder_rad(), kSample_s);
    device.command(handle.torques(Vector3::Zero()));
    device.step(kSample_s, {}, Vector3::Zero(), Vector3::Zero());
    worst_m = std::max(worst_m, (device.position_m() - at_m).norm());
  }
  return worst_m;
}

TEST(GravityCompensation, HoldsEveryPoseUnderEveryDirectionOfGravity) {
  Random random(11);
  double worst_m = 0.0;
  const int poses = campaign(100000, 100);
  for (int i = 0; i < poses; ++i) {
    DeviceConfig config = ideal();
    if (i % 2 == 1) config.gravity_m_per_s2 = 9.81 * in_unit_ball(random).normalized();
    worst_m = std::max(worst_m, drift_m(config, config.delta.workspace_m * in_unit_ball(random)));
  }
  std::printf("%d poses: drift at most %.3g m\n", poses, worst_m);
  EXPECT_LT(worst_m, 1e-4);
}

TEST(GravityCompensation, DoesNotHoldWhenTheMassesAreWrong) {
  DeviceConfig heavier = ideal();
  heavier.delta.platform_kg *= 1.01;
  SimulatedDelta device(heavier);
  DeltaHandle handle(ideal());
  for (int i = 0; i < 250; ++i) {
    handle.read(device.encoder_rad(), 4e-3);
    device.command(handle.torques(Vector3::Zero()));
    device.step(4e-3, {}, Vector3::Zero(), Vector3::Zero());
  }
  EXPECT_GT(device.position_m().norm(), 1e-4);
}

}  // namespace
}  // namespace longreach::gravity_hold_test
