#include "slave/safety/robot_watch.hpp"

#include <gtest/gtest.h>

#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::robot_watch_test {
namespace {

using std::chrono::milliseconds;

// Slave node and arm, with a master that engages and moves its goal; the arm's motors may be without power.
struct Watched {
  SlaveConfig config = test::wall_config(5.0, 1000.0);
  SlaveNode node{config};
  SimulatedArm arm{config, Random(4)};
  Time now{milliseconds(1000)};
  Received<MotionCommand> command{};
  bool powered = true;
  JointVector drift_rad_per_s = JointVector::Zero();  // of joints that move by themselves
  JointVector drifted_rad = JointVector::Zero();
  SlaveOutput out{};

  Watched() {
    command.message.engagement = 1;
    command.message.request = Request::kEngage;
  }
  void run(double seconds, double goal_m_per_s = 0.0) {
    for (int i = 0; i < static_cast<int>(seconds * 1e3); ++i) {
      now += milliseconds(1);
      command.message.position_m.x() -= 1e-3 * goal_m_per_s;
      ++command.sequence;
      command.sent = PeerTime{now.time_since_epoch()};
      command.received = now;
      command.echo_sent = now - milliseconds(2);
      SlaveInput in;
      in.now = now;
      in.robot = arm.read(now);
      drifted_rad += 1e-3 * drift_rad_per_s;
      in.robot.joint_rad += drifted_rad;
      in.robot.joint_rad_per_s += drift_rad_per_s;
      in.commands = {&command, 1};
      in.last_heard = now;
      in.peer_session_count = 1;
      out = node.step(in);
      if (powered) arm.write(out.joint_setpoint_rad);
    }
  }
};

TEST(RobotWatch, ARobotThatDoesWhatItIsToldIsNeverAtFault) {
  Watched w;
  w.run(0.5);
  ASSERT_TRUE(w.node.engaged());
  for (const double speed : {0.2, -0.25, 0.1}) w.run(2.0, speed);
  w.command.message.request = Request::kHold;
  w.run(3.0);
  EXPECT_EQ(w.node.view().state, SafetyState::kHolding);
  w.command.message.request = Request::kStop;
  w.run(3.0);
  EXPECT_EQ(w.node.view().state, SafetyState::kStopped);
}

TEST(RobotWatch, AMotorWithoutPowerIsAFaultAndNothingIsCommandedThen) {
  Watched w;
  w.run(0.5);
  w.powered = false;
  for (int i = 0; i < 100 && w.node.view().state == SafetyState::kEngaged; ++i) w.run(0.1, 0.2);
  EXPECT_EQ(w.node.view().state, SafetyState::kFault);
  EXPECT_EQ(w.node.view().cause, HoldCause::kTrackingLost);
  EXPECT_FALSE(w.out.joint_setpoint_rad);
  // Power again: nothing moves until the operator engages anew.
  w.powered = true;
  const Vector3 at_m = w.arm.true_pose().p;
  w.run(2.0);
  EXPECT_EQ(w.node.view().state, SafetyState::kFault);
  EXPECT_LT((w.arm.true_pose().p - at_m).norm(), 1e-6);
  w.command.message.engagement = 2;
  w.command.message.position_m.setZero();
  w.run(0.5);
  EXPECT_TRUE(w.node.engaged());
  EXPECT_LT((w.arm.true_pose().p - at_m).norm(), 1e-6);
}

TEST(RobotWatch, UncommandedJointMotionIsFaultAndBlocksEngagement) {
  for (const Request request : {Request::kHold, Request::kStop}) {
    Watched w;
    w.run(0.5);
    w.command.message.request = request;
    w.run(1.0);
    w.drift_rad_per_s[5] = 0.08;  // of 0.6 at most; 0.1 rad off after 1.25 s
    w.run(0.4);
    EXPECT_EQ(w.node.view().state, request == Request::kHold ? SafetyState::kHolding : SafetyState::kStopped);
    w.run(0.4);
    EXPECT_EQ(w.node.view().state, SafetyState::kFault);
    EXPECT_EQ(w.node.view().cause, HoldCause::kUncommandedMotion);
    w.command.message.request = Request::kEngage;
    w.command.message.engagement = 2;
    w.run(0.5);
    EXPECT_EQ(w.node.view().state, SafetyState::kFault);
    w.drift_rad_per_s.setZero();
    w.run(0.5);
    EXPECT_FALSE(w.node.engaged()) << "the request was refused for a fault";
    w.command.message.engagement = 3;
    w.run(0.5);
    EXPECT_TRUE(w.node.engaged());
  }
}

TEST(RobotWatch, ASlowDriftIsNoticedWhenTheRobotIsAstray) {
  Watched w;
  w.run(0.5);
  w.command.message.request = Request::kHold;
  w.run(0.5);
  w.drift_rad_per_s[0] = 0.01;  // less than a tenth of its limit
  w.run(9.0);
  EXPECT_EQ(w.node.view().state, SafetyState::kHolding);
  w.run(3.0);
  EXPECT_EQ(w.node.view().state, SafetyState::kFault);
  EXPECT_EQ(w.node.view().cause, HoldCause::kTrackingLost);
}

TEST(RobotWatch, ALinkThatSwingsToRestIsNotRestless) {
  const RobotConfig robot = test::space_arm();
  RobotWatch watch(robot);
  for (int i = 0; i < 10000; ++i) {
    RobotState state;
    const double t_s = 1e-3 * i;
    state.joint_rad[0] = 0.05 * std::sin(12.0 * t_s) * std::exp(-0.2 * t_s);
    state.joint_rad_per_s[0] = 0.6 * std::cos(12.0 * t_s) * std::exp(-0.2 * t_s);
    watch.step(state, JointVector::Zero(), true, true, 1e-3);
    ASSERT_FALSE(watch.uncommanded_motion() || watch.tracking_lost()) << t_s;
  }
}

}  // namespace
}  // namespace longreach::robot_watch_test
