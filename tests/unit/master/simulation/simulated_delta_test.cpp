#include "master/simulation/simulated_delta.hpp"
#include "master/devices/delta/delta_handle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::simulated_delta_test {
namespace {

DeviceConfig without_friction() {
  DeviceConfig config;
  config.delta.drive.viscous_nm_s_per_rad = 0.0;
  config.delta.drive.coulomb_nm = 0.0;
  config.delta.drive.resolution_rad = 0.0;
  config.delta.drive.bandwidth_hz = 0.0;
  return config;
}

/// A geometry whose joints do not meet.
DeviceConfig with_offset() {
  DeviceConfig config = without_friction();
  config.delta.arm_m = 0.06;
  config.delta.rod_m = 0.1025;
  config.delta.radius_m = 0.02557;
  config.delta.offset_m = 0.0225;
  config.delta.side_m = 0.00191;
  config.delta.upwards = true;
  config.delta.azimuth_rad = {1.8, -0.26, -2.36};
  config.delta.home_height_m = 0.11;
  config.delta.workspace_m = 0.03;
  return config;
}

Vector3 theta(const DeltaDynamics& d, const Vector3& p_m) { return d.kinematics().inverse(p_m).theta_rad; }

struct Place {
  Vector3 x_m, v_m_per_s;
};
std::vector<Place> places(double workspace_m) {
  Random random(3);
  std::vector<Place> all{{Vector3::Zero(), Vector3(0.1, -0.2, 0.3)}};
  for (int i = 0; i < 20; ++i) {
    const auto vector = [&] { return Vector3(random.normal(), random.normal(), random.normal()); };
    all.push_back({clamp_norm(0.5 * workspace_m * vector(), workspace_m), 0.3 * vector()});
  }
  return all;
}

TEST(DeltaDynamics, HasTheMassThatTheMovingLumpsHave) {
  for (const DeviceConfig& config : {without_friction(), with_offset()}) {
    const DeltaDynamics d(config.delta);
    const double axis = config.delta.drive.inertia_kg_m2 +
                        0.5 * config.delta.forearm_kg * config.delta.arm_m * config.delta.arm_m;
    for (const Place& at : places(config.delta.workspace_m)) {
      const Vector3 p = d.home_m() + at.x_m;
      // Kinetic energy of platform, forearm ends and drives by differences of the inverse kinematics.
      constexpr double kStep_s = 1e-5;
      const Vector3 rate =
          (theta(d, p + kStep_s * at.v_m_per_s) - theta(d, p - kStep_s * at.v_m_per_s)) / (2.0 * kStep_s);
      const double energy_j =
          0.5 * (config.delta.platform_kg + 1.5 * config.delta.forearm_kg) * at.v_m_per_s.squaredNorm() +
          0.5 * axis * rate.squaredNorm();
      const Matrix3 M = d.mass_kg(d.pose(p));
      EXPECT_NEAR(0.5 * at.v_m_per_s.dot(M * at.v_m_per_s), energy_j, 1e-7 * energy_j);
    }
  }
}

TEST(DeltaDynamics, KnowsHowTheAxesAccelerateInStraightMotion) {
  for (const DeviceConfig& config : {without_friction(), with_offset()}) {
    const DeltaDynamics d(config.delta);
    for (const Place& at : places(config.delta.workspace_m)) {
      const Vector3 p = d.home_m() + at.x_m, move = 1e-4 * at.v_m_per_s;
      const Vector3 second = (theta(d, p + move) - 2.0 * theta(d, p) + theta(d, p - move)) / 1e-8;
      const Vector3 bias = d.rate_bias(d.pose(p), at.v_m_per_s);
      EXPECT_LT((bias - second).norm(), 1e-5 * (1.0 + second.norm())) << at.x_m.transpose();
    }
  }
}

TEST(DeltaDynamics, WeighsWhatThePotentialEnergyLoses) {
  const Vector3 gravity(1.0, -2.0, -9.0);
  for (const DeviceConfig& config : {without_friction(), with_offset()}) {
    const DeltaDynamics d(config.delta);
    const auto energy = [&](const Vector3& p) {
      return potential_energy(d.geometry(), d.masses(), gravity, theta(d, p), p);
    };
    for (const Place& at : places(config.delta.workspace_m)) {
      const Vector3 p = d.home_m() + at.x_m;
      Vector3 force;
      for (int i = 0; i < 3; ++i)
        force[i] = -(energy(p + 1e-5 * Vector3::Unit(i)) - energy(p - 1e-5 * Vector3::Unit(i))) / 2e-5;
      EXPECT_LT((d.weight(d.pose(p), gravity) - force).norm(), 1e-7);
    }
  }
}

TEST(DeltaHandle, ReadsOnWhereAStrideLeadsAstray) {
  const DeltaDynamics d(with_offset().delta);
  DeltaHandle handle(with_offset());
  const Vector3 stride = 0.015 * Vector3(1.0, -0.2, 0.2).normalized();  // until one more would lead too far
  const auto found_from_next = [&](const Vector3& p) {
    const DeltaAssembly assembly = d.geometry().working_assembly();
    return d.kinematics().forward(theta(d, p), assembly, p + stride).status == SolutionStatus::kFound;
  };
  Vector3 p = d.home_m();
  ASSERT_TRUE(handle.read(theta(d, p), 0.0));
  for (int n = 0; n < 10 && found_from_next(p); ++n) {
    p += stride;
    ASSERT_TRUE(handle.read(theta(d, p), 1e-3)) << p.z();
  }
  ASSERT_FALSE(found_from_next(p));
  ASSERT_TRUE(handle.read(theta(d, p), 1e-3)) << "the hand stands still";
  EXPECT_LT((handle.position_m() + d.home_m() - p).norm(), 1e-14);
}

TEST(SimulatedDelta, KeepsItsEnergyInFreeMotion) {
  for (DeviceConfig config : {without_friction(), with_offset()}) {
    config.gravity_m_per_s2 = {0.3, 0.2, -1.0};
    const auto drift = [&](double step_s) {
      SimulatedDelta device(config);
      device.place({0.01, -0.005, 0.01});
      const double before_j = device.energy_j();
      double worst_j = 0.0;
      for (double t = 0.0; t < 0.15; t += step_s) {
        device.step(step_s, {}, Vector3::Zero(), Vector3::Zero());
        worst_j = std::max(worst_j, std::abs(device.energy_j() - before_j));
      }
      EXPECT_GT(device.velocity_m_per_s().norm(), 0.05);  // it does fall
      return worst_j;
    };
    const double coarse_j = drift(1e-3), fine_j = drift(2.5e-4);
    EXPECT_LT(coarse_j, 1e-7);
    EXPECT_LT(fine_j, coarse_j / 10.0);  // second order: a sixteenth
  }
}

TEST(SimulatedDelta, FollowsTheHandAsASecondOrderSystem) {
  DeviceConfig config = without_friction();
  config.gravity_m_per_s2.setZero();
  config.delta.drive.viscous_nm_s_per_rad = 0.02;
  SimulatedDelta device(config);
  const DeltaPose home = device.dynamics().pose(device.dynamics().home_m());
  const HandModel hand = hand_model(Grip::kLight);
  const double m = device.dynamics().mass_kg(home)(0, 0) + hand.mass_kg;
  const double b = 0.02 * (home.rates.transpose() * home.rates)(0, 0) + hand.damping_n_s_per_m;
  const double w0 = std::sqrt(hand.stiffness_n_per_m / m);
  const double zeta = b / (2.0 * std::sqrt(hand.stiffness_n_per_m * m));
  const double wd = w0 * std::sqrt(1.0 - zeta * zeta);
  constexpr double kTarget_m = 1e-3;
  for (int i = 1; i <= 500; ++i) {
    device.step(1e-3, hand, {kTarget_m, 0.0, 0.0}, Vector3::Zero());
    const double t = i * 1e-3;
    const double x =
        kTarget_m * (1.0 - std::exp(-zeta * w0 * t) * (std::cos(wd * t) + zeta * w0 / wd * std::sin(wd * t)));
    ASSERT_NEAR(device.position_m().x(), x, 2e-3 * kTarget_m) << "at tick " << i;
  }
}

TEST(SimulatedDelta, StaysInsideItsWorkspaceWhateverPullsIt) {
  const DeviceConfig config;
  for (const double pull_m : {0.2, 10.0, 1e6}) {
    SimulatedDelta device(config);
    for (int i = 0; i < 2000; ++i) {
      device.step(1e-3, hand_model(Grip::kFirm), {pull_m, 0.0, -pull_m}, Vector3::Zero());
      ASSERT_TRUE(device.position_m().allFinite());
    }
    if (pull_m < 1.0) {
      EXPECT_LT(device.position_m().norm(), config.delta.workspace_m + 0.006);
    }
  }
}

std::string refusal(const std::function<void(DeviceConfig&)>& change) {
  DeviceConfig config;
  change(config);
  try {
    SimulatedDelta{config};
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "none";
}

TEST(SimulatedDelta, RefusesByNameWhatCannotBe) {
  EXPECT_EQ(refusal([](DeviceConfig&) {}), "none");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.arm_m = -0.1; }), "arm_m is a length and must be positive");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.rod_m = std::nan(""); }), "rod_m is not a finite number");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.azimuth_rad[1] = 0.0; }), "azimuth: legs 1 and 2 coincide");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.home_height_m = 0.5; }),
            "home_height_m: the platform cannot reach this position");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.workspace_m = 0.2; }),
            "workspace_m: this distance exceeds the reach of the device in at least one direction");
  EXPECT_EQ(refusal([](DeviceConfig& c) { c.delta.platform_kg = -1.0; }),
            "platform must be a finite, non-negative mass");
}

}  // namespace
}  // namespace longreach::simulated_delta_test
