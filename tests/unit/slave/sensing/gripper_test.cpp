// The gripper follows the newest command of the engagement, and nothing else makes it let go.
#include <gtest/gtest.h>

#include <optional>

#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::gripper_test {
namespace {

struct Loop {
  SlaveConfig config = test::wall_config(1.0, 1000.0);
  SlaveNode node{config};
  SimulatedArm arm{config, Random(1)};
  Time now{std::chrono::milliseconds(5000)};
  MotionCommand command{};
  std::uint64_t sequence = 0;
  std::optional<Time> last_heard{};
  bool holds = false;

  std::optional<bool> run(int ticks, bool silent = false) {
    SlaveOutput out;
    for (int i = 0; i < ticks; ++i) {
      now += std::chrono::milliseconds(1);
      Received<MotionCommand> r;
      r.sequence = ++sequence;
      r.sent = PeerTime{now.time_since_epoch()};
      r.received = now;
      r.echo_sent = now - std::chrono::milliseconds(40);
      r.message = command;
      SlaveInput in;
      in.now = now;
      in.robot = arm.read(now);
      in.robot.load = holds;
      in.peer_session_count = 1;
      if (!silent) {
        last_heard = now;
        in.commands = {&r, 1};
      }
      in.last_heard = last_heard;
      out = node.step(in);
      arm.write(out.joint_setpoint_rad);
    }
    return out.grip;
  }
};

TEST(Gripper, FollowsTheCommandsOfTheEngagementOnly) {
  Loop loop;
  loop.command.grip = true;
  EXPECT_EQ(loop.run(200), std::nullopt) << "not engaged";
  loop.command.engagement = 1;
  loop.command.request = Request::kEngage;
  EXPECT_EQ(loop.run(200), true);
  ASSERT_TRUE(loop.node.engaged());
  EXPECT_EQ(loop.run(3000, true), true) << "silence drops nothing";
  EXPECT_FALSE(loop.node.engaged());
  loop.command.request = Request::kStop;
  loop.command.grip = false;
  EXPECT_EQ(loop.run(200), true) << "neither does a stop";
  loop.command.request = Request::kEngage;
  loop.command.engagement = 2;
  EXPECT_EQ(loop.run(500), false);
  ASSERT_TRUE(loop.node.engaged());
}

TEST(Gripper, StaysAsItIsUnderAMasterThatAsksForNothing) {
  Loop loop;
  loop.holds = true;
  loop.command.engagement = 1;
  loop.command.request = Request::kEngage;
  EXPECT_EQ(loop.run(300), std::nullopt);
  ASSERT_TRUE(loop.node.engaged());
  EXPECT_TRUE(loop.node.view().gripper.closed && loop.node.view().gripper.holds) << "as the robot says";
  loop.command.grip = false;
  EXPECT_EQ(loop.run(100), false);
  EXPECT_FALSE(loop.node.view().gripper.closed);
  loop.command.grip.reset();
  EXPECT_EQ(loop.run(100), false);
}

}  // namespace
}  // namespace longreach::gripper_test
