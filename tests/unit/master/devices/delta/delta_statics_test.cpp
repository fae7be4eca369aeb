#include "master/devices/delta/delta_statics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/devices/delta_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach::delta_statics_test {
namespace {

struct Pose3 {
  Vector3 theta, p;
  DeltaVelocity at;
};

/// Regular poses of a device, away from singularity.
std::vector<Pose3> poses(const DeltaGeometry& g, int wanted) {
  const DeltaKinematics k(g);
  Random random(5);
  std::vector<Pose3> result;
  while (static_cast<int>(result.size()) < wanted) {
    const Vector3 p =
        g.size_m() * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const DeltaAngles angles = k.inverse(p, static_cast<unsigned>(random.next() % 8));
    if (angles.status != SolutionStatus::kFound) continue;
    const DeltaVelocity at = velocity(g, angles.theta_rad, p);
    const DeltaSingularity distance = singularity(g, at);
    if (std::min(distance.arm, distance.rods) > 0.2) result.push_back({angles.theta_rad, p, at});
  }
  return result;
}

std::vector<DeltaDesign> designs() { return {reconstructed_delta(), novint_falcon(), omega_like()}; }

Vector3 forward(const DeltaGeometry& g, const Pose3& pose, const Vector3& theta) {
  const DeltaAssembly assembly =
      pose.at.rods.determinant() > 0.0 ? DeltaAssembly::kPositive : DeltaAssembly::kNegative;
  return DeltaKinematics(g).forward(theta, assembly, pose.p).p_m;
}

TEST(DeltaStatics, HasTheJacobianOfItsFiniteDifferences) {
  constexpr double kStep = 1e-5;
  for (const DeltaDesign& d : designs()) {
    for (const Pose3& pose : poses(d.geometry, 500)) {
      const DeltaJacobian J = jacobian(pose.at);
      ASSERT_EQ(J.status, SolutionStatus::kFound);
      for (int i = 0; i < 3; ++i) {
        const Vector3 change = kStep * Vector3::Unit(i);
        const Vector3 slope = (forward(d.geometry, pose, pose.theta + change) -
                               forward(d.geometry, pose, pose.theta - change)) /
                              (2.0 * kStep);
        ASSERT_LE((slope - J.m_per_rad.col(i)).norm() / d.geometry.arm_m(), 1e-7);
      }
    }
  }
}

// A small motion of the platform does at the hand the work that it does at the motors.
TEST(DeltaStatics, DoesTheSameWorkAtTheHandAndAtTheMotors) {
  Random random(6);
  for (const DeltaDesign& d : designs()) {
    const DeltaKinematics k(d.geometry);
    for (const Pose3& pose : poses(d.geometry, 500)) {
      const Vector3 force(random.normal(), random.normal(), random.normal());
      const Vector3 motion =
          1e-6 * d.geometry.size_m() * Vector3(random.normal(), random.normal(), random.normal());
      Vector3 turned;
      for (int i = 0; i < 3; ++i) {  // the leg's own root next to the present one
        const DeltaRoots after = k.inverse_all(pose.p + motion), before = k.inverse_all(pose.p - motion);
        const bool first =
            std::abs(std::remainder(after.first_rad[i] - pose.theta[i], 2.0 * std::numbers::pi)) <
            std::abs(std::remainder(after.second_rad[i] - pose.theta[i], 2.0 * std::numbers::pi));
        turned[i] =
            first ? after.first_rad[i] - before.first_rad[i] : after.second_rad[i] - before.second_rad[i];
      }
      const DeltaTorques torques = statics(pose.at, force);
      ASSERT_EQ(torques.status, SolutionStatus::kFound);
      const double at_hand = 2.0 * force.dot(motion);
      ASSERT_NEAR(torques.tau_nm.dot(turned), at_hand, 1e-6 * force.norm() * motion.norm());
    }
  }
}

TEST(DeltaStatics, CarriesItsWeightAlongTheGradientOfThePotential) {
  constexpr double kStep = 1e-5;
  Random random(7);
  for (const DeltaDesign& d : designs()) {
    for (const Pose3& pose : poses(d.geometry, 500)) {
      const Vector3 gravity = 9.81 * Vector3(random.normal(), random.normal(), random.normal()).normalized();
      const DeltaTorques torques = gravity_torques(d.geometry, d.masses, gravity, pose.theta, pose.at);
      ASSERT_EQ(torques.status, SolutionStatus::kFound);
      for (int i = 0; i < 3; ++i) {
        const auto energy = [&](double change) {
          const Vector3 theta = pose.theta + change * Vector3::Unit(i);
          return potential_energy(d.geometry, d.masses, gravity, theta, forward(d.geometry, pose, theta));
        };
        ASSERT_NEAR(torques.tau_nm[i], (energy(kStep) - energy(-kStep)) / (2.0 * kStep), 1e-8);
      }
    }
  }
}

// Arms straight out with the weight of a lever: m g L, whatever the platform does, since it weighs nothing.
TEST(DeltaStatics, CarriesAHorizontalArmLikeALever) {
  const DeltaGeometry g = omega_like().geometry;
  const DeltaPosition p = DeltaKinematics(g).forward(Vector3::Zero(), g.working_assembly(), Vector3::Zero());
  ASSERT_EQ(p.status, SolutionStatus::kFound);
  const DeltaVelocity at = velocity(g, Vector3::Zero(), p.p_m);
  const DeltaTorques torques = gravity_torques(g, {0.0, 2.0, 0.5, 0.0}, {0, 0, -9.81}, Vector3::Zero(), at);
  // Positive angles turn the arms down, so what holds them up is negative.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(torques.tau_nm[i], -2.0 * 9.81 * 0.5 * 0.110, 1e-12);
}

TEST(DeltaStatics, TorquesMatchPublishedDevice) {
  const DeltaDesign d = reconstructed_delta();
  const DeltaKinematics k(d.geometry);
  const auto torques = [&](const Vector3& p) {
    const Vector3 theta = k.inverse(p).theta_rad;
    return Vector3(
        -gravity_torques(d.geometry, d.masses, {0, 0, -9.81}, theta, velocity(d.geometry, theta, p)).tau_nm);
  };
  const Vector3 home = torques(d.home_m);
  const Vector3 above = torques(d.home_m + Vector3(1.5243e-3, 17.6991e-3, 33.3409e-3));
  const Vector3 published_home(16.18e-3, 16.28e-3, 16.34e-3), published_above(15.62e-3, 13.45e-3, 18.76e-3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(home[i], published_home[i], 0.07 * published_home[i]);
    EXPECT_NEAR(above[i], published_above[i], 0.07 * published_above[i]);
  }
}

TEST(DeltaStatics, SaysThatItIsSingularWhereTheRodsLieInAPlane) {
  // Arms and rods of one length, arms straight out, platform in the plane of the motors.
  const DeltaGeometry g(DeltaSimple{0.1, 0.1, 0.2, {0.0, 2.0, 4.0}});
  const DeltaVelocity at = velocity(g, Vector3::Zero(), Vector3::Zero());
  EXPECT_LT(singularity(g, at).rods, 1e-9);
  EXPECT_LT(singularity(g, at).arm, 1e-9);
  EXPECT_EQ(jacobian(at).status, SolutionStatus::kSingular);
  EXPECT_EQ(statics(at, Vector3::UnitZ()).status, SolutionStatus::kSingular);
  EXPECT_EQ(statics(at, Vector3::UnitZ()).tau_nm, Vector3::Zero());
  const DeltaPosition p = DeltaKinematics(g).forward(Vector3::Zero(), g.working_assembly(), Vector3::Ones());
  EXPECT_EQ(p.status, SolutionStatus::kSingular);
  EXPECT_EQ(p.p_m, Vector3::Ones());
}

}  // namespace
}  // namespace longreach::delta_statics_test
