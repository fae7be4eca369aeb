#include "slave/kinematics/numeric_inverse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/random.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::numeric_inverse_test {
namespace {

// Ordinary: within the limits, elbow and wrist well away from singular, the wrist not above the base.
JointVector ordinary_joints(Random& random) {
  JointVector q;
  q << random.uniform(-2.5, 2.5), random.uniform(0.2, 1.3), random.uniform(-2.2, -0.6),
      random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-3.0, 3.0);
  return q;
}

Vector3 random_vector(Random& random, double length) {
  const Vector3 v(random.normal(), random.normal(), random.normal());
  return length * v.normalized();
}

TEST(NumericInverse, FindsTheNextMillisecondInAtMostThreeSteps) {
  const NumericInverse inverse(test::space_arm());
  const Kinematics kinematics(test::space_arm());
  Random random(2);
  std::uint32_t most = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const JointVector q = ordinary_joints(random);
    if (kinematics.forward(q).p.head<2>().norm() < 5.0) continue;
    Pose goal = kinematics.forward(q);
    goal.p += random_vector(random, 0.25e-3);
    goal.q = exp_rotation(random_vector(random, 0.3e-3)) * goal.q;
    const NumericResult result = inverse.solve(to_rigid(goal), q, {});
    ASSERT_TRUE(result.found) << "seed 2, trial " << trial;
    const Pose X = kinematics.forward(result.joint_rad);
    ASSERT_LT((X.p - goal.p).norm(), 1.01e-10) << "trial " << trial;
    ASSERT_LT(X.q.angularDistance(goal.q), 1e-10) << "trial " << trial;
    most = std::max(most, result.iterations);
  }
  EXPECT_LE(most, 3U);
}

TEST(NumericInverse, FindsPosesFromTenthsOfARadianAway) {
  const NumericInverse inverse(test::space_arm());
  Random random(3);
  int found = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const JointVector q = ordinary_joints(random);
    JointVector start = q;
    for (int i = 0; i < kMaxJoints; ++i) start[i] += random.uniform(-0.1, 0.1);
    const NumericResult result = inverse.solve(inverse.kinematics().rigid_forward(q), start, {1e-10, 50});
    if (result.found) ++found;
  }
  EXPECT_GE(found, kTrials * 999 / 1000);
}

TEST(NumericInverse, KeepsTheJointLimits) {
  const RobotConfig robot = test::space_arm();
  const NumericInverse inverse(robot);
  JointVector beyond = test::start_joints();
  beyond[4] = robot.joint[4].max_rad + 0.1;
  JointVector start = beyond;
  start[4] = robot.joint[4].max_rad - 0.01;
  const NumericResult result = inverse.solve(inverse.kinematics().rigid_forward(beyond), start, {});
  EXPECT_FALSE(result.found);
  EXPECT_TRUE(result.at_joint_limit);
  for (int i = 0; i < kMaxJoints; ++i) {
    EXPECT_GE(result.joint_rad[i], robot.joint[static_cast<std::size_t>(i)].min_rad);
    EXPECT_LE(result.joint_rad[i], robot.joint[static_cast<std::size_t>(i)].max_rad);
  }
}

TEST(NumericInverse, AnswersOutOfReachWithTheNearestAndSaysSo) {
  const NumericInverse inverse(test::space_arm());
  Pose goal = inverse.kinematics().forward(test::start_joints());
  goal.p *= 3.0;
  const NumericResult result = inverse.solve(to_rigid(goal), test::start_joints(), {1e-10, 100});
  EXPECT_FALSE(result.found);
  EXPECT_TRUE(result.joint_rad.allFinite());
  EXPECT_LT(result.iterations, 101U);
}

TEST(NumericInverse, TakesSmallStepsNearASingularPose) {
  const NumericInverse inverse(test::space_arm());
  JointVector q = test::start_joints();
  q[2] = -0.101;  // the elbow almost straight
  q[4] = 1.39;
  Pose goal = inverse.kinematics().forward(q);
  goal.p += 0.25e-3 * goal.p.normalized();
  const NumericResult result = inverse.solve(to_rigid(goal), q, {});
  EXPECT_LT((result.joint_rad - q).cwiseAbs().maxCoeff(), 0.05);
}

TEST(NumericInverse, LeavesTheJointsForAGoalThatIsNotFinite) {
  const NumericInverse inverse(test::space_arm());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Pose goal = inverse.kinematics().forward(test::start_joints());
    goal.p.y() = bad;
    for (const std::uint32_t restarts : {0U, 200U}) {
      const NumericResult result = inverse.solve(to_rigid(goal), test::start_joints(), {1e-10, 20, restarts});
      EXPECT_FALSE(result.found);
      EXPECT_EQ(result.joint_rad, test::start_joints());
    }
  }
}

// At rest, beside it, and up to half a turn, where the sine of the angle says nothing.
TEST(Rigid, TheChordIsTwiceTheSineOfHalfTheAngle) {
  constexpr double kHalfTurn = 3.14159265358979323846;
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  const Matrix3 from = exp_rotation({0.3, 0.2, -0.7}).toRotationMatrix();
  for (const double angle : {0.0, 1e-12, 1e-4, 1.0, 3.0, kHalfTurn - 1e-4, kHalfTurn - 1e-7, kHalfTurn}) {
    const Matrix3 to = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * from;
    const Vector3 chord = chord_between(from, to);
    EXPECT_NEAR(chord.norm(), 2.0 * std::sin(0.5 * angle), 1e-7) << angle;
    EXPECT_NEAR(std::abs(chord.dot(axis)), chord.norm(), 1e-7) << angle;
  }
}

}  // namespace
}  // namespace longreach::numeric_inverse_test
