#include "slave/simulation/flexible_joint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slave/simulation/simulated_arm.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::flexible_joint_test {
namespace {

JointConfig joint(double stiffness, double damping, double friction, double inertia) {
  JointConfig j;
  j.stiffness_nm_per_rad = stiffness;
  j.damping_nm_s_per_rad = damping;
  j.friction_nm = friction;
  j.inertia_kg_m2 = inertia;
  return j;
}

// Classical Runge-Kutta in fine steps.
LinkState integrate(const JointConfig& j, LinkState link, const ServoMotion& servo, double torque, double t) {
  constexpr int kSteps = 20000;
  const double h = t / kSteps;
  const auto acceleration = [&](double at, double q, double v) {
    return (j.stiffness_nm_per_rad * (servo.rad + servo.rad_per_s * at - q) +
            j.damping_nm_s_per_rad * (servo.rad_per_s - v) + torque) /
           j.inertia_kg_m2;
  };
  for (int n = 0; n < kSteps; ++n) {
    const double at = n * h, q = link.rad, v = link.rad_per_s;
    const double a1 = acceleration(at, q, v), v2 = v + 0.5 * h * a1;
    const double a2 = acceleration(at + 0.5 * h, q + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
    const double a3 = acceleration(at + 0.5 * h, q + 0.5 * h * v2, v3), v4 = v + h * a3;
    const double a4 = acceleration(at + h, q + h * v3, v4);
    link.rad += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    link.rad_per_s += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return link;
}

TEST(FlexibleJoint, IsExactBelowAtAndAboveCriticalDamping) {
  for (const double damping : {0.0, 3.0, 40.0, 400.0}) {  // critical: 2 √(K M) = 40
    const JointConfig j = joint(200.0, damping, 0.0, 2.0);
    const LinkState link{0.3, -1.0};
    const ServoMotion servo{0.1, 0.5};
    const LinkState there = swing(j, link, servo, 7.0, 0.4), expected = integrate(j, link, servo, 7.0, 0.4);
    EXPECT_NEAR(there.rad, expected.rad, 1e-11) << damping;
    EXPECT_NEAR(there.rad_per_s, expected.rad_per_s, 1e-10) << damping;
  }
}

TEST(FlexibleJoint, WithoutDampingItsEnergyStays) {
  const JointConfig j = joint(1e4, 0.0, 0.0, 3.0);
  LinkState link{0.01, 0.0};
  for (int i = 0; i < 100000; ++i) link = swing(j, link, {}, 0.0, 1e-3);
  const double energy = 0.5 * 1e4 * link.rad * link.rad + 0.5 * 3.0 * link.rad_per_s * link.rad_per_s;
  EXPECT_NEAR(energy, 0.5, 1e-9);
}

TEST(FlexibleJoint, SticksWithinItsFrictionAndBreaksLooseBeyond) {
  const JointConfig j = joint(100.0, 1.0, 2.0, 1.0);
  EXPECT_EQ(swing(j, {0.0, 0.0}, {0.019, 0.0}, 0.0, 1e-3).rad, 0.0);
  EXPECT_GT(swing(j, {0.0, 0.0}, {0.021, 0.0}, 0.0, 1e-3).rad, 0.0);
  LinkState link{0.5, 0.0};
  for (int i = 0; i < 20000; ++i) link = swing(j, link, {}, 0.0, 1e-3);
  EXPECT_EQ(link.rad_per_s, 0.0);
  EXPECT_LE(std::abs(link.rad), 2.0 / 100.0);
}

TEST(FlexibleJoint, ExtremesStayFinite) {
  for (const double stiffness : {1e-9, 1e9}) {
    for (const double damping : {0.0, 1e-9, 1e9}) {
      for (const double inertia : {1e-9, 1e9}) {
        const LinkState link = swing(joint(stiffness, damping, 1.0, inertia), {1.0, 1.0}, {}, 1.0, 1e-3);
        EXPECT_TRUE(std::isfinite(link.rad) && std::isfinite(link.rad_per_s));
      }
    }
  }
}

// Static: F = k p and the tool yields by the compliance of its joints, J K⁻¹ Jᵀ F.
TEST(SimulatedArm, FlexibleJointsYieldToTheForce) {
  SlaveConfig config = test::wall_config(-0.002, 1000.0);  // starts 2 mm deep
  for (JointConfig& j : config.robot.joint) {
    j.stiffness_nm_per_rad = 1e5;
    j.damping_nm_s_per_rad = 3e4;
    j.inertia_kg_m2 = 1e3;
  }
  SimulatedArm arm(config, Random(1));
  Time now{};
  for (int i = 0; i < 60000; ++i) {
    now += std::chrono::milliseconds(1);
    arm.read(now);
    arm.write(test::start_joints());
  }
  const Kinematics kinematics(config.robot);
  const double compliance =
      kinematics.forward_with_jacobian(test::start_joints()).J.row(3).squaredNorm() / 1e5;
  EXPECT_NEAR(-arm.true_wrench().force.x(), 2.0 / (1.0 + 1000.0 * compliance), 1e-4);
  EXPECT_LT((arm.true_pose().p - arm.start_pose().p).x(), -1e-6);
}

}  // namespace
}  // namespace longreach::flexible_joint_test
