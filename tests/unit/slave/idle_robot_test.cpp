// When the robot is commanded, and that nothing which it says of its joints moves it.

#include "tests/unit/slave/node_loop.hpp"

namespace longreach::idle_robot_test {
namespace {

using test::Loop;

TEST(SlaveNode, CommandsRobotOnlyWhileEngagedHoldingOrStopping) {
  Loop loop(test::wall_config(5.0, 1000.0));
  const auto commanded = [&](double seconds) {
    int ticks = 0;
    for (int i = 0; i < static_cast<int>(1e3 * seconds); ++i) {
      loop.tick();
      ticks += loop.out.joint_setpoint_rad.has_value();
    }
    return ticks;
  };
  loop.silent = true;
  EXPECT_EQ(commanded(0.5), 0);
  EXPECT_EQ(loop.view().state, SafetyState::kIdle);
  loop.silent = false;
  EXPECT_EQ(commanded(0.5), 0);
  EXPECT_EQ(loop.view().state, SafetyState::kObserving);
  loop.engage();
  loop.move_to(0.05, 0.1);
  ASSERT_TRUE(loop.out.joint_setpoint_rad);
  loop.command.request = Request::kHold;
  EXPECT_EQ(commanded(2.0), 2000);
  EXPECT_EQ(loop.view().state, SafetyState::kHolding);
  // Stopped in motion: it brakes under setpoints, then rests by itself.
  loop.engage(2);
  loop.move_to(0.1, 0.1);
  loop.command.request = Request::kStop;
  EXPECT_GT(commanded(0.1), 90);
  EXPECT_EQ(loop.view().state, SafetyState::kStopped);
  loop.run(1.5);
  const Vector3 at_m = loop.arm.true_pose().p;
  EXPECT_EQ(commanded(2.0), 0);
  EXPECT_EQ(loop.arm.true_pose().p, at_m);
  // A robot that has failed is not commanded from that tick on.
  loop.engage(3);
  loop.move_to(0.15, 0.1);
  loop.broken = {};
  loop.broken.ok = false;
  loop.use_broken = true;
  EXPECT_EQ(commanded(1.0), 0);
  EXPECT_EQ(loop.view().state, SafetyState::kFault);
  loop.use_broken = false;
  EXPECT_EQ(commanded(1.0), 0);
}

TEST(SlaveNode, ARobotMovedBySomebodyElseStaysThereAndIsEngagedThere) {
  Loop loop(test::wall_config(5.0, 1000.0));
  loop.run(0.2);
  JointVector q = test::start_joints();
  for (int i = 0; i < 1000; ++i) {
    q[0] += 0.2e-3;
    q[5] += 0.3e-3;
    loop.arm.displace(q);
    loop.tick();
    ASSERT_FALSE(loop.out.joint_setpoint_rad);
  }
  const Vector3 at_m = loop.arm.true_pose().p;
  ASSERT_GT((at_m - loop.arm.start_pose().p).norm(), 1.0);
  loop.run(1.0);
  EXPECT_EQ(loop.arm.true_pose().p, at_m);
  loop.command.engagement = 1;
  loop.command.request = Request::kEngage;
  while (!loop.out.joint_setpoint_rad) loop.tick();
  EXPECT_LT((*loop.out.joint_setpoint_rad - q).norm(), 1e-6);
  loop.run(1.0);
  ASSERT_TRUE(loop.node.engaged());
  EXPECT_LT((loop.arm.true_pose().p - at_m).norm(), 1e-6);
  EXPECT_EQ(loop.view().limit_violations, 0U);
}

TEST(SlaveNode, AnEngagementWaitsUntilTheRobotRestsWithinItsLimits) {
  const auto waits = [](const std::function<void(RobotState&)>& sensor_fault) {
    Loop loop(test::wall_config(5.0, 1000.0));
    loop.run(0.2);
    loop.sensor_fault = sensor_fault;
    loop.command.engagement = 1;
    loop.command.request = Request::kEngage;
    loop.run(0.4);
    const bool waited = !loop.node.engaged() && loop.view().unready != HoldCause::kNone;
    loop.sensor_fault = {};
    loop.run(0.1);
    return waited && loop.node.engaged();
  };
  EXPECT_TRUE(waits([](RobotState& robot) { robot.joint_rad_per_s[0] = 0.006; }));
  EXPECT_FALSE(waits([](RobotState& robot) { robot.joint_rad_per_s[0] = 0.004; }));
  EXPECT_FALSE(waits([](RobotState&) {}));
  // Beyond a joint's limit, and outside the workspace of 3 m: nothing calls it back.
  const std::pair<int, double> places[] = {{4, 1.4 + 0.01}, {0, 0.5}};
  for (const auto& [joint, rad] : places) {
    Loop loop(test::wall_config(5.0, 1000.0));
    JointVector q = test::start_joints();
    q[joint] = rad;
    loop.arm.displace(q);
    loop.command.engagement = 1;
    loop.command.request = Request::kEngage;
    loop.run(0.5);
    EXPECT_EQ(loop.view().state, SafetyState::kObserving) << joint;
    const HoldCause why = joint == 4 ? HoldCause::kJointLimit : HoldCause::kToolOutside;
    EXPECT_EQ(loop.view().unready, why) << joint;
    EXPECT_EQ(loop.view().refused, 1U);
    EXPECT_EQ(loop.view().refusal, why);
  }
}

TEST(SlaveNode, FalseJointReadingsAreAFaultAndMoveNothing) {
  struct SensorFaultKind {
    const char* what;
    std::function<void(RobotState&)> tell;
    HoldCause cause = HoldCause::kJointJumped;
  };
  const SensorFaultKind sensor_faults[] = {
      {"leap", [](RobotState& robot) { robot.joint_rad[1] += 0.3; }},
      {"all", [](RobotState& robot) { robot.joint_rad.array() += 1.0; }},
      {"huge", [](RobotState& robot) { robot.joint_rad[0] = 1e300; }},
      {"speed", [](RobotState& robot) { robot.joint_rad_per_s[0] = 1e9; }, HoldCause::kJointTooFast},
      {"beyond", [](RobotState& robot) { robot.joint_rad[4] = -1.7; }}};
  for (const SensorFaultKind& sensor_fault : sensor_faults) {
    Loop loop(test::wall_config(5.0, 1000.0));
    loop.engage();
    loop.move_to(0.2, 0.1);
    JointVector before = *loop.out.joint_setpoint_rad;
    const Vector3 at_m = loop.arm.true_pose().p;
    loop.sensor_fault = sensor_fault.tell;
    for (int i = 0; i < 1000; ++i) {
      if (i == 20) loop.sensor_fault = {};
      loop.tick();
      ASSERT_NE(loop.view().state, SafetyState::kEngaged) << sensor_fault.what;
      if (!loop.out.joint_setpoint_rad) continue;
      ASSERT_LT((*loop.out.joint_setpoint_rad - before).cwiseAbs().maxCoeff(), 1e-3) << sensor_fault.what;
      before = *loop.out.joint_setpoint_rad;
    }
    EXPECT_EQ(loop.view().state, SafetyState::kFault) << sensor_fault.what;
    EXPECT_EQ(loop.view().cause, sensor_fault.cause) << sensor_fault.what;
    // Braking from 0.1 m/s, by the slowest of the joints.
    EXPECT_LT((loop.arm.true_pose().p - at_m).norm(), 0.01) << sensor_fault.what;
    loop.command.position_m.setZero();
    loop.engage(2);
    loop.run(0.5);
    EXPECT_TRUE(loop.node.engaged()) << sensor_fault.what;
    EXPECT_LT((loop.arm.true_pose().p - at_m).norm(), 0.01) << sensor_fault.what;
  }
}

}  // namespace
}  // namespace longreach::idle_robot_test
