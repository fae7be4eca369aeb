#include "slave/kinematics/kinematics.hpp"

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::kinematics_test {
namespace {

using test::kPi;

JointVector random_joints(const RobotConfig& robot, Random& random) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    q[i] = random.uniform(j.min_rad, j.max_rad);
  }
  return q;
}

TEST(Kinematics, PlacesTheSpaceArmWhereTrigonometryDoes) {
  const Kinematics kinematics(test::space_arm());
  const Pose X = kinematics.forward(test::start_joints());
  const double x = 6.38 * std::cos(kPi / 3) + 7.06 * std::cos(-kPi / 6) + 0.46 + 0.76 + 0.66;
  const double z = 6.38 * std::sin(kPi / 3) + 7.06 * std::sin(-kPi / 6);
  EXPECT_NEAR((X.p - Vector3(x, 0, z)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((X.q * Vector3::UnitZ() - Vector3::UnitX()).norm(), 0.0,
              1e-14);  // the roll axis points along x
}

TEST(Kinematics, EachJointTurnsAboutItsOwnAxis) {
  const Kinematics kinematics(test::space_arm());
  const double wrist_x = 6.38 * std::cos(kPi / 3) + 7.06 * std::cos(-kPi / 6);
  const double z = 6.38 * std::sin(kPi / 3) + 7.06 * std::sin(-kPi / 6);
  JointVector q = test::start_joints();
  q[0] = kPi / 2;  // shoulder yaw: the arm points along y
  EXPECT_NEAR((kinematics.forward(q).p - Vector3(0, wrist_x + 1.88, z)).norm(), 0.0, 1e-13);
  q = test::start_joints();
  q[3] += kPi / 2;  // wrist pitch: the wrist points up
  EXPECT_NEAR((kinematics.forward(q).p - Vector3(wrist_x, 0, z + 1.88)).norm(), 0.0, 1e-13);
  q = test::start_joints();
  q[4] = kPi / 2;  // wrist yaw: the last 1.42 m point along y
  EXPECT_NEAR((kinematics.forward(q).p - Vector3(wrist_x + 0.46, 1.42, z)).norm(), 0.0, 1e-13);
  q = test::start_joints();
  q[5] = 0.7;  // wrist roll: turns about x and moves nothing
  const Quaternion turn = kinematics.forward(q).q * kinematics.forward(test::start_joints()).q.conjugate();
  EXPECT_NEAR((log_rotation(turn) - Vector3(0.7, 0, 0)).norm(), 0.0, 1e-13);
  EXPECT_DOUBLE_EQ(kinematics.reach_m(), 15.32);
}

TEST(Kinematics, JacobianAgreesWithFiniteDifferences) {
  RobotConfig robot = test::space_arm();
  robot.joint[2].d_m = 0.31;  // offsets and odd twists too
  robot.joint[3].alpha_rad = 0.4;
  const Kinematics kinematics(robot);
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const JointVector q = random_joints(robot, random);
    const ToolKinematics tool = kinematics.forward_with_jacobian(q);
    const Pose X = kinematics.forward(q);
    EXPECT_LT((X.p - tool.X_WE.p).norm() + X.q.angularDistance(tool.X_WE.q), 1e-12);
    for (int i = 0; i < kMaxJoints; ++i) {
      constexpr double kH = 1e-6;
      JointVector plus = q, minus = q;
      plus[i] += kH;
      minus[i] -= kH;
      const Pose a = kinematics.forward(plus), b = kinematics.forward(minus);
      const Vector3 linear = (a.p - b.p) / (2 * kH);
      const Vector3 angular = log_rotation(a.q * b.q.conjugate()) / (2 * kH);
      EXPECT_LT((tool.J.col(i).tail<3>() - linear).norm(), 1e-7) << "trial " << trial << " joint " << i;
      EXPECT_LT((tool.J.col(i).head<3>() - angular).norm(), 1e-8) << "trial " << trial << " joint " << i;
    }
  }
}

}  // namespace
}  // namespace longreach::kinematics_test
