#include "slave/safety/joint_plausibility.hpp"

#include <gtest/gtest.h>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach::joint_plausibility_test {
namespace {

struct JointCheckRun {
  JointPlausibility plausibility{test::space_arm()};
  RobotState robot{};
  Time now{std::chrono::seconds(10)};

  JointCheckRun() { robot.joint_rad = test::start_joints(); }
  HoldCause after(double seconds) {
    now += from_seconds(seconds);
    return plausibility.check(robot, now);
  }
};

TEST(JointPlausibility, AcceptsPossibleJointMotion) {
  JointCheckRun w;
  for (int i = 0; i < 2000; ++i) {
    w.robot.joint_rad[5] += 0.6e-3;
    w.robot.joint_rad_per_s[5] = 0.6;
    ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  }
  // As much in 0.1 s, in which nothing came, or came late.
  w.robot.joint_rad[5] += 0.06;
  EXPECT_EQ(w.after(0.1), HoldCause::kNone);
}

TEST(JointPlausibility, ALeapIsDoubtedUntilItIsTakenBack) {
  JointCheckRun w;
  ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  w.robot.joint_rad[1] += 0.3;
  const Reason found = w.plausibility.check(w.robot, w.now + std::chrono::milliseconds(1));
  EXPECT_EQ(found, HoldCause::kJointJumped);
  EXPECT_EQ(found.joint, 2);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(w.after(1.0), HoldCause::kJointJumped);
  w.robot.joint_rad[1] -= 0.3;
  EXPECT_EQ(w.after(1e-3), HoldCause::kNone);
}

TEST(JointPlausibility, ARobotThatRestedForLongLeapsAllTheSame) {
  JointCheckRun w;
  for (int i = 0; i < 10'000; ++i) ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  w.robot.joint_rad[1] += 0.1;
  EXPECT_EQ(w.after(1e-3), HoldCause::kJointJumped);
}

TEST(JointPlausibility, WhatIsOldIsNoNewSample) {
  JointCheckRun w;
  ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  // The same sample for 0.2 s, then what the joint did meanwhile.
  for (int i = 1; i <= 200; ++i) {
    w.robot.age_s = 1e-3 * i;
    ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  }
  w.robot.age_s = 0.0;
  w.robot.joint_rad[1] += 0.25 * 0.2;
  EXPECT_EQ(w.after(1e-3), HoldCause::kNone);
}

TEST(JointPlausibility, ARobotThatHasFailedMayBeElsewhereWhenItWorksAgain) {
  JointCheckRun w;
  ASSERT_EQ(w.after(1e-3), HoldCause::kNone);
  w.robot.joint_rad[1] += 0.3;
  ASSERT_EQ(w.after(1e-3), HoldCause::kJointJumped);
  w.plausibility.forget();
  EXPECT_EQ(w.after(1e-3), HoldCause::kNone);
}

TEST(JointPlausibility, DoubtsWhatIsBeyondLimitsOfPositionAndSpeed) {
  JointCheckRun w;
  w.robot.joint_rad[4] = 1.4 + 0.09;
  EXPECT_EQ(w.after(1e-3), HoldCause::kNone);
  w.robot.joint_rad[4] = 1.4 + 0.11;
  EXPECT_EQ(w.after(1e-3), HoldCause::kJointOutside);
  w.robot.joint_rad[4] = 1.4 + 0.09;
  w.robot.joint_rad_per_s[4] = -1e9;
  EXPECT_EQ(w.after(1e-3), HoldCause::kJointTooFast);
  w.robot.joint_rad_per_s[4] = -0.6;
  EXPECT_EQ(w.after(1e-3), HoldCause::kNone);
}

TEST(JointPlausibility, LimitsHoldBothWaysForEachJoint) {
  const RobotConfig arm = test::space_arm();
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = arm.joint[static_cast<std::size_t>(i)];
    for (const double rad : {j.min_rad - 0.11, j.min_rad - 0.09, j.max_rad + 0.09, j.max_rad + 0.11}) {
      JointCheckRun w;
      w.robot.joint_rad[i] = rad;
      const bool outside = rad < j.min_rad - 0.1 || rad > j.max_rad + 0.1;
      EXPECT_EQ(w.after(1e-3), outside ? HoldCause::kJointOutside : HoldCause::kNone) << i << ' ' << rad;
    }
    for (const double way : {-1.0, 1.0}) {
      JointCheckRun w;
      w.robot.joint_rad_per_s[i] = way * (10.0 * j.speed_max_rad_per_s + 0.09);
      EXPECT_EQ(w.after(1e-3), HoldCause::kNone) << i;
      w.robot.joint_rad_per_s[i] = way * (10.0 * j.speed_max_rad_per_s + 0.11);
      EXPECT_EQ(w.after(1e-3), HoldCause::kJointTooFast) << i;
    }
  }
}

TEST(JointPlausibility, AFixedJointMayBeToldAnything) {
  RobotConfig arm = test::space_arm();
  arm.joint[2].kind = JointKind::kFixed;
  JointPlausibility plausibility(arm);
  RobotState robot;
  robot.joint_rad = test::start_joints();
  for (int i = 0; i < 3; ++i) {
    robot.joint_rad[2] = 50.0 * i;
    robot.joint_rad_per_s[2] = 1e6;
    EXPECT_EQ(plausibility.check(robot, Time{std::chrono::seconds(i)}), HoldCause::kNone) << i;
  }
}

}  // namespace
}  // namespace longreach::joint_plausibility_test
