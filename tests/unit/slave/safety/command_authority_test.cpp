#include "slave/safety/command_authority.hpp"

#include <gtest/gtest.h>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach::command_authority_test {
namespace {

using State = SafetyState;

struct AuthorityRun {
  CommandAuthority authority{test::space_arm()};

  bool step(State state, bool setpoint_rests = false, bool robot_ok = true, double seconds = 1e-3) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i)
      authority.step({state, robot_ok, setpoint_rests, 1e-3});
    return authority.commands();
  }
};

TEST(CommandAuthority, OnlyWhoIsEngagedOrHoldsCommands) {
  for (const State state : {State::kIdle, State::kObserving, State::kStopped, State::kFault}) {
    AuthorityRun r;
    EXPECT_FALSE(r.step(state)) << "nobody has engaged";
    EXPECT_TRUE(r.step(State::kEngaged));
    EXPECT_TRUE(r.step(State::kHolding, true, true, 5.0)) << "a hold lasts";
    EXPECT_EQ(r.step(state), state == State::kStopped || state == State::kFault);
  }
}

TEST(CommandAuthority, AStopEndsHalfASecondAfterTheSetpointHasComeToRest) {
  for (const State state : {State::kStopped, State::kFault}) {
    AuthorityRun r;
    r.step(State::kEngaged);
    EXPECT_TRUE(r.step(state, false, true, 3.0)) << "it brakes";
    EXPECT_TRUE(r.step(state, true, true, 0.45));
    EXPECT_TRUE(r.step(state, false)) << "it moves again";
    EXPECT_TRUE(r.step(state, true, true, 0.45));
    EXPECT_FALSE(r.step(state, true, true, 0.06));
    EXPECT_FALSE(r.step(state, false)) << "and does not begin again";
  }
}

TEST(CommandAuthority, ARobotAtFaultIsNotCalled) {
  AuthorityRun r;
  r.step(State::kEngaged);
  EXPECT_FALSE(r.step(State::kFault, false, false));
  EXPECT_FALSE(r.step(State::kFault));
}

TEST(CommandAuthority, EngagementOfCommandedRobotNeedsItAtSetpoint) {
  AuthorityRun r;
  r.step(State::kHolding);
  RobotState robot;
  robot.joint_rad = test::start_joints();
  JointVector setpoint = test::start_joints();
  EXPECT_EQ(r.authority.why_not(robot, setpoint), HoldCause::kNone);
  setpoint[3] -= 0.049;
  EXPECT_EQ(r.authority.why_not(robot, setpoint), HoldCause::kNone);
  setpoint[3] -= 0.002;
  EXPECT_NE(r.authority.why_not(robot, setpoint), HoldCause::kNone);
}

TEST(CommandAuthority, EngagementNeedsRobotAtRestWithinLimits) {
  AuthorityRun r;
  const RobotConfig arm = test::space_arm();
  const JointVector elsewhere = JointVector::Constant(9.0);
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = arm.joint[static_cast<std::size_t>(i)];
    RobotState robot;
    robot.joint_rad = test::start_joints();
    EXPECT_EQ(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << "an old setpoint does not matter";
    for (const double way : {-1.0, 1.0}) {
      robot.joint_rad_per_s[i] = way * 0.019 * j.speed_max_rad_per_s;
      EXPECT_EQ(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << i;
      robot.joint_rad_per_s[i] = way * 0.021 * j.speed_max_rad_per_s;
      EXPECT_NE(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << i;
    }
    robot.joint_rad_per_s[i] = 0.0;
    robot.joint_rad[i] = j.max_rad + 0.9e-3;
    EXPECT_EQ(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << i;
    robot.joint_rad[i] = j.max_rad + 1.1e-3;
    EXPECT_NE(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << i;
    robot.joint_rad[i] = j.min_rad - 1.1e-3;
    EXPECT_NE(r.authority.why_not(robot, elsewhere), HoldCause::kNone) << i;
  }
}

TEST(CommandAuthority, AFixedJointMayBeToldAnything) {
  RobotConfig arm = test::space_arm();
  arm.joint[2].kind = JointKind::kFixed;
  const CommandAuthority authority(arm);
  RobotState robot;
  robot.joint_rad = test::start_joints();
  robot.joint_rad[2] = 100.0;
  robot.joint_rad_per_s[2] = 100.0;
  EXPECT_EQ(authority.why_not(robot, robot.joint_rad), HoldCause::kNone);
}

}  // namespace
}  // namespace longreach::command_authority_test
