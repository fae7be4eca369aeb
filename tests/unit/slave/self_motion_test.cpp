#include "slave/robot/self_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach {
namespace {

// A wrist of three axes through one point behind a shoulder and an elbow: q₅ = 0 is singular.
RobotConfig wristed() {
  RobotConfig robot;
  const double half = test::kPi / 2;
  robot.joint[0] = {0.0, half, 0.5, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  robot.joint[1] = {0.4, 0.0, 0.0, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  robot.joint[2] = {0.0, -half, 0.0, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  robot.joint[3] = {0.0, half, 0.4, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  robot.joint[4] = {0.0, -half, 0.0, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  robot.joint[5] = {0.0, 0.0, 0.1, 0.0, -3.0, 3.0, 1.0, 5.0, 0.0};
  return robot;
}

SelfMotion from(double q5) {
  SelfMotion start;
  start.joint_rad << 0.3, 0.9, -1.2, 0.4, q5, 0.2;
  start.min_rad.setConstant(-3.0);
  start.max_rad.setConstant(3.0);
  start.pull_rad.setZero();
  start.lost = 5e-3;
  return start;
}

TEST(SelfMotion, TurnsTheWristUnderAStillToolWhereTheWristIsSingular) {
  const Kinematics arm(wristed());
  SelfMotion at = from(0.0);
  const Rigid goal = arm.rigid_forward(at.joint_rad);
  const JointVector start_rad = at.joint_rad;
  for (int n = 0; n < 1000; ++n) {
    at.pull_rad << 0.0, 0.0, 0.0, 1e-3, 0.0, -1e-3;
    at.joint_rad = self_motion_step(arm, at, goal);
  }
  EXPECT_NEAR(at.joint_rad[3] - start_rad[3], 1.0, 1e-3);
  EXPECT_NEAR(at.joint_rad[5] - start_rad[5], -1.0, 1e-3);
  EXPECT_LT((arm.rigid_forward(at.joint_rad).p - goal.p).norm(), 1e-6);
  EXPECT_LT(rotation_between(arm.rigid_forward(at.joint_rad).R, goal.R).norm(), 1e-6);
}

TEST(SelfMotion, FollowsTheToolAndNotThePullWhereNothingIsLost) {
  const Kinematics arm(wristed());
  SelfMotion at = from(-0.9);
  Rigid goal = arm.rigid_forward(at.joint_rad);
  goal.p += Vector3(1e-3, -1e-3, 5e-4);
  at.pull_rad.setConstant(1e-3);
  const double left_m = (arm.rigid_forward(self_motion_step(arm, at, goal)).p - goal.p).norm();
  EXPECT_LT(left_m, 0.02 * 1.5e-3);  // of the way
}

TEST(SelfMotion, StaysAtTheSolutionHoweverSingularItIs) {
  const Kinematics arm(wristed());
  for (const double q5 : {0.0, 1e-9, 1e-4, 1e-2, 1.0}) {
    const SelfMotion at = from(q5);
    const JointVector q = self_motion_step(arm, at, arm.rigid_forward(at.joint_rad));
    EXPECT_LT((q - at.joint_rad).cwiseAbs().maxCoeff(), 1e-12) << q5;
  }
}

TEST(SelfMotion, AJointAtItsLimitStaysThereAndTheOthersMakeUpForIt) {
  const Kinematics arm(wristed());
  SelfMotion at = from(-0.01);
  at.max_rad[3] = at.joint_rad[3] + 1e-4;
  at.pull_rad << 0.0, 0.0, 0.0, 1e-2, 0.0, -1e-2;
  const Rigid goal = arm.rigid_forward(at.joint_rad);
  const JointVector q = self_motion_step(arm, at, goal);
  EXPECT_EQ(q[3], at.max_rad[3]);
  EXPECT_LT(rotation_between(arm.rigid_forward(q).R, goal.R).norm(), 1e-4);
}

}  // namespace
}  // namespace longreach
