#include "master/simulation/simulated_spherical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::simulated_spherical_test {
namespace {

DeviceConfig without_friction() {
  DeviceConfig config;
  config.spherical.drive.viscous_nm_s_per_rad = 0.0;
  config.spherical.drive.coulomb_nm = 0.0;
  config.spherical.drive.resolution_rad = 0.0;
  config.spherical.drive.bandwidth_hz = 0.0;
  return config;
}

Vector3 theta(const SphericalDynamics& d, const Quaternion& q) { return d.kinematics().inverse(q).theta_rad; }

struct Attitude {
  Quaternion q;
  Vector3 omega_rad_per_s;
};
std::vector<Attitude> attitudes() {
  Random random(5);
  std::vector<Attitude> all;
  for (int i = 0; i < 20; ++i) {
    const auto vector = [&] { return Vector3(random.normal(), random.normal(), random.normal()); };
    all.push_back({exp_rotation(clamp_norm(0.4 * vector(), 0.8)), vector()});
  }
  return all;
}

TEST(SphericalDynamics, HasTheInertiaAndTheAxisRatesOfTheInverseKinematics) {
  const DeviceConfig config = without_friction();
  const SphericalDynamics d(config.spherical);
  for (const Attitude& at : attitudes()) {
    const auto turned = [&](double t) { return theta(d, exp_rotation(t * at.omega_rad_per_s) * at.q); };
    const Vector3 rate = (turned(1e-5) - turned(-1e-5)) / 2e-5;
    const double energy_j = 0.5 * config.spherical.inertia_kg_m2 * at.omega_rad_per_s.squaredNorm() +
                            0.5 * config.spherical.drive.inertia_kg_m2 * rate.squaredNorm();
    const SphericalAttitude pose = d.attitude(at.q);
    ASSERT_TRUE(pose.closed);
    EXPECT_NEAR(0.5 * at.omega_rad_per_s.dot(d.inertia_kg_m2(pose) * at.omega_rad_per_s), energy_j,
                1e-7 * energy_j);
    // At constant angular velocity.
    const Vector3 second = (turned(1e-4) - 2.0 * turned(0.0) + turned(-1e-4)) / 1e-8;
    EXPECT_LT((d.rate_bias(pose, at.omega_rad_per_s) - second).norm(), 1e-5 * (1.0 + second.norm()));
  }
}

TEST(SimulatedSpherical, KeepsItsEnergyInFreeMotion) {
  // A wrist without damping: what the handle gains its spring loses.
  const auto drift = [](double step_s) {
    SimulatedSpherical device(without_friction());
    device.place(exp_rotation({0.3, -0.2, 0.25}));
    const WristModel spring{0.0, 0.4};
    const auto total_j = [&] {
      return device.energy_j() + 0.2 * log_rotation(device.orientation()).squaredNorm();
    };
    const double before_j = total_j();
    double worst_j = 0.0, fastest = 0.0;
    for (double t = 0.0; t < 0.5; t += step_s) {
      device.step(step_s, spring, Vector3::Zero());
      worst_j = std::max(worst_j, std::abs(total_j() - before_j));
      fastest = std::max(fastest, device.angular_rad_per_s().norm());
    }
    EXPECT_GT(fastest, 10.0);
    return worst_j / before_j;
  };
  const double coarse = drift(1e-3), fine = drift(2.5e-4);
  EXPECT_LT(coarse, 0.01);
  EXPECT_LT(fine, coarse / 10.0);  // second order
}

TEST(SimulatedSpherical, StaysInsideItsWorkspaceWhateverTurnsIt) {
  const DeviceConfig config;
  for (const Vector3& pull : {Vector3(3.0, 0.0, 0.0), Vector3(0.0, 0.0, -3.0), Vector3(1e3, 1e3, 1e3)}) {
    SimulatedSpherical device(config);
    for (int i = 0; i < 2000; ++i) {
      device.step(1e-3, wrist_model(Grip::kFirm), pull);
      ASSERT_LT(log_rotation(device.orientation()).norm(), config.spherical.workspace_rad + 0.4);
    }
  }
}

TEST(SimulatedSpherical, RefusesByNameWhatCannotBe) {
  const auto refusal = [](auto change) -> std::string {
    DeviceConfig config;
    change(config.spherical);
    try {
      SimulatedSpherical{config};
    } catch (const GeometryError& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal([](SphericalConfig&) {}), "none");
  EXPECT_EQ(refusal([](SphericalConfig& c) { c.workspace_rad = 1.5; }),
            "workspace_rad: this angle exceeds the rotation range of the device about at least one axis");
  EXPECT_NE(refusal([](SphericalConfig& c) { c.alpha1_rad = std::nan(""); }).find("alpha1"),
            std::string::npos);
  EXPECT_NE(refusal([](SphericalConfig& c) { c.alpha2_rad = -1.0; }).find("alpha2"), std::string::npos);
}

}  // namespace
}  // namespace longreach::simulated_spherical_test
