#include "slave/safety/command_right.hpp"

#include <gtest/gtest.h>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach {
namespace {

using State = SafetyState;

struct Right {
  CommandRight right{test::space_arm()};

  bool step(State state, bool setpoint_rests = false, bool robot_ok = true, double seconds = 1e-3) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) right.step({state, robot_ok, setpoint_rests, 1e-3});
    return right.commands();
  }
};

TEST(CommandRight, OnlyWhoIsEngagedOrHoldsCommands) {
  for (const State state : {State::kIdle, State::kObserving, State::kStopped, State::kFault}) {
    Right r;
    EXPECT_FALSE(r.step(state)) << "nobody has engaged";
    EXPECT_TRUE(r.step(State::kEngaged));
    EXPECT_TRUE(r.step(State::kHolding, true, true, 5.0)) << "a hold lasts";
    EXPECT_EQ(r.step(state), state == State::kStopped || state == State::kFault);
  }
}

TEST(CommandRight, AStopEndsHalfASecondAfterTheSetpointHasComeToRest) {
  for (const State state : {State::kStopped, State::kFault}) {
    Right r;
    r.step(State::kEngaged);
    EXPECT_TRUE(r.step(state, false, true, 3.0)) << "it brakes";
    EXPECT_TRUE(r.step(state, true, true, 0.45));
    EXPECT_TRUE(r.step(state, false)) << "it moves again";
    EXPECT_TRUE(r.step(state, true, true, 0.45));
    EXPECT_FALSE(r.step(state, true, true, 0.06));
    EXPECT_FALSE(r.step(state, false)) << "and does not begin again";
  }
}

TEST(CommandRight, ARobotAtFaultIsNotCalled) {
  Right r;
  r.step(State::kEngaged);
  EXPECT_FALSE(r.step(State::kFault, false, false));
  EXPECT_FALSE(r.step(State::kFault));
}

TEST(CommandRight, AnEngagementOfARobotThatIsCommandedNeedsItAtItsSetpoint) {
  Right r;
  r.step(State::kHolding);
  RobotState robot;
  robot.joint_rad = test::start_joints();
  JointVector setpoint = test::start_joints();
  EXPECT_EQ(r.right.why_not(robot, setpoint), HoldCause::kNone);
  setpoint[3] -= 0.049;
  EXPECT_EQ(r.right.why_not(robot, setpoint), HoldCause::kNone);
  setpoint[3] -= 0.002;
  EXPECT_NE(r.right.why_not(robot, setpoint), HoldCause::kNone);
}

TEST(CommandRight, AnEngagementOfARobotAtRestNeedsItStillAndWithinItsLimits) {
  Right r;
  const RobotConfig arm = test::space_arm();
  const JointVector elsewhere = JointVector::Constant(9.0);
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = arm.joint[static_cast<std::size_t>(i)];
    RobotState robot;
    robot.joint_rad = test::start_joints();
    EXPECT_EQ(r.right.why_not(robot, elsewhere), HoldCause::kNone) << "an old setpoint does not matter";
    for (const double way : {-1.0, 1.0}) {
      robot.joint_rad_per_s[i] = way * 0.019 * j.speed_max_rad_per_s;
      EXPECT_EQ(r.right.why_not(robot, elsewhere), HoldCause::kNone) << i;
      robot.joint_rad_per_s[i] = way * 0.021 * j.speed_max_rad_per_s;
      EXPECT_NE(r.right.why_not(robot, elsewhere), HoldCause::kNone) << i;
    }
    robot.joint_rad_per_s[i] = 0.0;
    robot.joint_rad[i] = j.max_rad + 0.9e-3;
    EXPECT_EQ(r.right.why_not(robot, elsewhere), HoldCause::kNone) << i;
    robot.joint_rad[i] = j.max_rad + 1.1e-3;
    EXPECT_NE(r.right.why_not(robot, elsewhere), HoldCause::kNone) << i;
    robot.joint_rad[i] = j.min_rad - 1.1e-3;
    EXPECT_NE(r.right.why_not(robot, elsewhere), HoldCause::kNone) << i;
  }
}

TEST(CommandRight, AFixedJointMayBeToldAnything) {
  RobotConfig arm = test::space_arm();
  arm.joint[2].kind = JointKind::kFixed;
  const CommandRight right(arm);
  RobotState robot;
  robot.joint_rad = test::start_joints();
  robot.joint_rad[2] = 100.0;
  robot.joint_rad_per_s[2] = 100.0;
  EXPECT_EQ(right.why_not(robot, robot.joint_rad), HoldCause::kNone);
}

}  // namespace
}  // namespace longreach
