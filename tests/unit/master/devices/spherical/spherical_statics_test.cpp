#include "master/devices/spherical/spherical_statics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach::spherical_statics_test {
namespace {

struct Pose4 {
  Vector3 theta;
  Quaternion q;
  unsigned mode = 0;
  SphericalVelocity at;
};

std::vector<Pose4> poses(const SphericalGeometry& g, int wanted) {
  const SphericalKinematics k(g);
  Random random(8);
  std::vector<Pose4> result;
  while (static_cast<int>(result.size()) < wanted) {
    const Quaternion q =
        Quaternion(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    const unsigned mode = static_cast<unsigned>(random.next() % 8);
    const SphericalMotors motors = k.inverse(q, mode);
    if (motors.status != SolutionStatus::kFound) continue;
    const SphericalVelocity at = velocity(g, motors.theta_rad, q);
    const SphericalSingularity distance = singularity(g, at);
    if (std::min(distance.legs, distance.platform) > 0.2) result.push_back({motors.theta_rad, q, mode, at});
  }
  return result;
}

TEST(SphericalStatics, HasTheJacobianOfItsFiniteDifferences) {
  constexpr double kStep = 1e-5;
  for (const SphericalGeometry& g : {agile_eye(), reconstructed_spherical(), compact_spherical()}) {
    const SphericalKinematics k(g);
    for (const Pose4& pose : poses(g, 500)) {
      const SphericalJacobian J = jacobian(pose.at), back = inverse_jacobian(pose.at);
      ASSERT_EQ(J.status, SolutionStatus::kFound);
      ASSERT_EQ(back.status, SolutionStatus::kFound);
      for (int i = 0; i < 3; ++i) {
        const Vector3 turn = kStep * Vector3::Unit(i);
        const Vector3 ahead = k.inverse(exp_rotation(turn) * pose.q, pose.mode).theta_rad;
        const Vector3 behind = k.inverse(exp_rotation(-turn) * pose.q, pose.mode).theta_rad;
        Vector3 slope;
        for (int leg = 0; leg < 3; ++leg)
          slope[leg] = std::remainder(ahead[leg] - behind[leg], 2.0 * std::numbers::pi) / (2.0 * kStep);
        ASSERT_LE((slope - J.matrix.col(i)).norm(), 1e-7);
        // The other way: motors move, the platform turns.
        const SphericalPose here{SolutionStatus::kFound, pose.q};
        const Quaternion q1 = k.forward(pose.theta + turn, here).q, q0 = k.forward(pose.theta - turn, here).q;
        const Vector3 omega = log_rotation(q1 * q0.conjugate()) / (2.0 * kStep);
        ASSERT_LE((omega - back.matrix.col(i)).norm(), 1e-7);
      }
    }
  }
}

// M . ω = τ . θ' for the motion that the solver itself makes.
TEST(SphericalStatics, DoesTheSameWorkAtTheHandAndAtTheMotors) {
  Random random(9);
  for (const SphericalGeometry& g : {reconstructed_spherical(), compact_spherical()}) {
    const SphericalKinematics k(g);
    for (const Pose4& pose : poses(g, 500)) {
      const Vector3 moment(random.normal(), random.normal(), random.normal());
      const Vector3 turned = 1e-5 * Vector3(random.normal(), random.normal(), random.normal());
      const SphericalTorque torque = statics(pose.at, moment);
      ASSERT_EQ(torque.status, SolutionStatus::kFound);
      const SphericalPose here{SolutionStatus::kFound, pose.q};
      const Quaternion q1 = k.forward(pose.theta + turned, here).q,
                       q0 = k.forward(pose.theta - turned, here).q;
      const double at_hand = moment.dot(log_rotation(q1 * q0.conjugate()));
      ASSERT_NEAR(2.0 * torque.nm.dot(turned), at_hand, 1e-7 * moment.norm() * turned.norm());
    }
  }
}

}  // namespace
}  // namespace longreach::spherical_statics_test
