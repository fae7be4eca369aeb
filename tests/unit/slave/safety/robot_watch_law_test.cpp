// The law of the robot's watch by itself: measured joints in, verdict out.

#include <gtest/gtest.h>

#include "slave/safety/robot_watch.hpp"

namespace longreach::robot_watch_law_test {
namespace {

constexpr double kDt = 1e-3;

RobotConfig robot_with_servo(double hz) {
  RobotConfig robot;
  robot.servo_hz = hz;
  for (JointConfig& j : robot.joint) j.speed_max_rad_per_s = 1.0;
  return robot;
}

RobotState at(double rad, double rad_per_s = 0.0) {
  RobotState robot;
  robot.joint_rad = JointVector::Constant(rad);
  robot.joint_rad_per_s = JointVector::Constant(rad_per_s);
  return robot;
}

void run(RobotWatch& watch, double seconds, const RobotState& robot, bool commanded = true,
         bool rests = true) {
  for (int i = 0; i < static_cast<int>(seconds / kDt); ++i)
    watch.step(robot, JointVector::Zero(), commanded, rests, kDt);
}

TEST(RobotWatchLaw, AJointThatIsOffForHalfASecondIsAstrayWithAnyServo) {
  for (const double hz : {0.0, 10.0}) {
    RobotWatch watch(robot_with_servo(hz));
    run(watch, 1.0, at(0.0));
    run(watch, 0.45, at(-0.2));
    EXPECT_FALSE(watch.tracking_lost()) << hz;
    run(watch, 0.1, at(-0.2));
    EXPECT_TRUE(watch.tracking_lost()) << hz;
    run(watch, 0.01, at(0.05));
    EXPECT_FALSE(watch.tracking_lost()) << "it is back, " << hz;
  }
}

TEST(RobotWatchLaw, NobodyCommandsARobotThatMayBeAnywhere) {
  RobotWatch watch(robot_with_servo(10.0));
  run(watch, 5.0, at(1.0), false);
  EXPECT_FALSE(watch.tracking_lost());
}

TEST(RobotWatchLaw, JointMovedDuringStallLosesTrackingAtOnce) {
  RobotWatch watch(robot_with_servo(0.0));
  run(watch, 1.0, at(0.0));
  watch.step(at(0.05), JointVector::Zero(), true, true, kDt, true);
  EXPECT_FALSE(watch.tracking_lost()) << "within what a joint gives way by";
  watch.step(at(0.2), JointVector::Zero(), true, true, kDt, true);
  EXPECT_TRUE(watch.tracking_lost());
}

TEST(RobotWatchLaw, DetectsUncommandedMotionAfterServoSettles) {
  for (const double hz : {0.0, 1.0}) {
    const double settling_s = hz > 0.0 ? 0.4775 : 0.0;  // 3/(2π f)
    RobotWatch watch(robot_with_servo(hz));
    run(watch, settling_s + 0.48, at(0.0, 0.2));
    EXPECT_FALSE(watch.uncommanded_motion()) << hz;
    run(watch, 0.05, at(0.0, 0.2));
    EXPECT_TRUE(watch.uncommanded_motion()) << hz;
    run(watch, 0.01, at(0.0, 0.05));
    EXPECT_FALSE(watch.uncommanded_motion()) << "slower than a tenth of its limit, " << hz;
    run(watch, 5.0, at(0.0, 0.2), true, false);
    EXPECT_FALSE(watch.uncommanded_motion()) << "its setpoint moves, " << hz;
  }
}

}  // namespace
}  // namespace longreach::robot_watch_law_test
