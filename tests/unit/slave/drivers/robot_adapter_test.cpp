// A real robot behind its adapter, in virtual time.

#include "slave/drivers/robot_adapter.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "slave/slave_node.hpp"
#include "tests/support/adapter_end.hpp"

namespace longreach::robot_adapter_test {
namespace {

using adapter::RobotDatagram;
using adapter::SetpointDatagram;

/// That of deploy/robots/cartesian.txtpb.
RobotConfig cartesian() {
  RobotConfig robot;
  for (std::size_t i = 0; i < 6; ++i) {
    robot.joint[i].kind = i < 3 ? JointKind::kPrismatic : JointKind::kFixed;
    robot.joint[i].min_rad = -1.0;
    robot.joint[i].max_rad = 1.0;
  }
  robot.joint[0].alpha_rad = -0.5 * std::numbers::pi;
  robot.joint[1].theta_rad = robot.joint[1].alpha_rad = 0.5 * std::numbers::pi;
  return robot;
}

RobotDatagram robot_at(double x_m) {
  RobotDatagram d;
  d.flags = RobotDatagram::kOk;
  d.joint_rad[2] = x_m;
  return d;
}

struct RobotAdapterTest : ::testing::Test {
  MemoryChannelPair wire;
  RobotAdapter robot{wire.a(), {}, cartesian(), 5};
  AdapterEnd<SetpointDatagram, RobotDatagram> end{wire.b()};

  /// The adapter sends, both step, the setpoint comes.
  std::optional<SetpointDatagram> tick(SlaveNode& node, double ms, std::optional<double> x_m) {
    if (x_m) end.send(robot_at(*x_m));
    SlaveInput in;
    in.now = at_ms(ms);
    in.robot = robot.read(in.now);
    const SlaveOutput out = node.step(in);
    robot.write(out.joint_setpoint_rad);
    return end.receive(in.now);
  }
};

constexpr std::uint32_t kClosed = SetpointDatagram::kGrip | SetpointDatagram::kGripAsked;

TEST_F(RobotAdapterTest, TurnsTheWrenchFromTheToolIntoTheWorld) {
  RobotDatagram d = robot_at(0.1);
  d.flags |= RobotDatagram::kLoad;
  d.joint_rad_per_s[1] = 0.2;
  d.force_n[2] = -7.0;  // along z of the tool, which is x of the world
  d.moment_nm[2] = 0.5;
  end.send(d);
  const RobotState s = robot.read(at_ms(0));
  EXPECT_TRUE(s.ok && s.load);
  EXPECT_EQ(s.joint_rad[2], 0.1);
  EXPECT_EQ(s.joint_rad_per_s[1], 0.2);
  EXPECT_LT((s.F_F_W.force - Vector3(-7, 0, 0)).norm(), 1e-12);
  EXPECT_LT((s.F_F_W.moment - Vector3(0.5, 0, 0)).norm(), 1e-12);
}

TEST_F(RobotAdapterTest, NothingMovesBeforeTheRobotHasSaidWhereItIs) {
  robot.write(JointVector::Constant(0.5));
  auto in = end.receive(at_ms(0));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags & SetpointDatagram::kMove, 0u);
  end.send(robot_at(0.1));
  (void)robot.read(at_ms(1));
  robot.grip(true);
  robot.write(JointVector::Constant(0.5));
  in = end.receive(at_ms(1));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags, SetpointDatagram::kMove | kClosed);
  EXPECT_EQ(in->joint_rad[5], 0.5);
  robot.write(JointVector::Constant(NAN));
  in = end.receive(at_ms(1));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags, kClosed);
  EXPECT_EQ(robot.rejected_setpoints(), 1u);
  robot.write(std::nullopt);
  in = end.receive(at_ms(1));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags, kClosed);  // what it holds it keeps
  EXPECT_EQ(robot.rejected_setpoints(), 1u);
}

// The slave may have been started again while the robot held something.
TEST_F(RobotAdapterTest, ALoadThatIsThereIsKeptUntilSomebodyAsks) {
  const auto sent = [this] {
    robot.write(std::nullopt);
    const auto in = end.receive(at_ms(2));
    return in ? in->flags : ~0U;
  };
  EXPECT_EQ(sent(), 0U) << "whatever the gripper is, it stays";
  RobotDatagram d = robot_at(0.1);
  d.flags |= RobotDatagram::kLoad;
  end.send(d);
  (void)robot.read(at_ms(1));
  EXPECT_EQ(sent(), SetpointDatagram::kGrip);
  robot.grip(false);
  EXPECT_EQ(sent(), SetpointDatagram::kGripAsked);
}

TEST_F(RobotAdapterTest, ARobotThatNobodyEngagedIsSentNoMotion) {
  SlaveConfig config;
  config.robot = cartesian();
  SlaveNode node(config);
  for (int ms = 0; ms <= 2000; ++ms) {
    const auto in = tick(node, ms, 0.1 + 1e-4 * ms);  // somebody moves it
    ASSERT_TRUE(in);
    ASSERT_EQ(in->flags & SetpointDatagram::kMove, 0u) << ms;
    ASSERT_NEAR(node.view().X_WE_goal.p.x(), 0.1 + 1e-4 * ms, 1e-9);
  }
}

TEST_F(RobotAdapterTest, TwentyMillisecondsOfSilenceAreAFaultAndNothingMoves) {
  SlaveConfig config;
  config.robot = cartesian();
  SlaveNode node(config);
  for (int ms = 0; ms <= 50; ++ms) ASSERT_TRUE(tick(node, ms, 0.1));
  for (int ms = 51; ms < 70; ++ms) {
    const auto in = tick(node, ms, {});
    ASSERT_TRUE(in);
    EXPECT_NE(node.view().state, SafetyState::kFault) << ms;
  }
  const auto in = tick(node, 70, {});
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags & SetpointDatagram::kMove, 0u);
  EXPECT_EQ(node.view().state, SafetyState::kFault);
  EXPECT_EQ(node.view().cause, HoldCause::kRobotFault);
}

TEST_F(RobotAdapterTest, ARobotThatComesBackElsewhereIsLeftThere) {
  SlaveConfig config;
  config.robot = cartesian();
  SlaveNode node(config);
  for (int ms = 0; ms <= 50; ++ms) {
    const auto in = tick(node, ms, 0.1);
    ASSERT_TRUE(in);
    EXPECT_NEAR(node.view().X_WE_goal.p.x(), 0.1, 1e-12);
  }
  for (int ms = 51; ms < 100; ++ms) (void)tick(node, ms, {});
  end.exchange = adapter::Exchange(1234);
  for (int ms = 100; ms < 150; ++ms) {
    const auto in = tick(node, ms, 0.14);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->flags & SetpointDatagram::kMove, 0u);
    EXPECT_NEAR(node.view().X_WE_goal.p.x(), 0.14, 1e-12) << ms;
  }
  EXPECT_EQ(node.view().state, SafetyState::kFault);  // until it is engaged
}

TEST_F(RobotAdapterTest, ARobotThatSaysItHasFailedHasFailed) {
  end.send(robot_at(0.1));
  ASSERT_TRUE(robot.read(at_ms(0)).ok);
  for (int i = 0; i < 50; ++i) robot.write(JointVector::Zero());
  RobotDatagram d = robot_at(0.3);
  d.flags = RobotDatagram::kStopped;
  end.send(d);
  const RobotState s = robot.read(at_ms(1));
  EXPECT_FALSE(s.ok);
  EXPECT_EQ(s.joint_rad[2], 0.1);
  EXPECT_TRUE(robot.watchdog_stopped());
}

}  // namespace
}  // namespace longreach::robot_adapter_test
