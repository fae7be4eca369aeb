#pragma once
// The slave's node and the simulated arm in a loop with a minimal master, which sends 200 commands per second
// that arrive after 20 ms.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::test {

struct Loop {
  explicit Loop(const SlaveConfig& config) : node(config), arm(config, Random(9)) {
    command.request = Request::kHold;
    commands.reserve(8);
  }

  SlaveNode node;
  SimulatedArm arm;
  Time now{std::chrono::milliseconds(5000)};
  MotionCommand command{};
  std::uint64_t sequence = 0;
  std::uint32_t sessions = 1;
  bool silent = false;
  bool lost = false;  // commands are sent but do not arrive
  bool echo = true;
  RobotState broken{};
  bool use_broken = false;
  std::function<void(RobotState&)> sensor_fault{};  // modifies the state that the robot reports
  std::vector<Received<MotionCommand>> commands;
  std::optional<Time> last_heard;
  SlaveOutput out;
  std::optional<StiffnessReport> last_report;
  std::vector<double> goals_x;  // indexed by sequence number
  int reports = 0, telemetry = 0;

  const SlaveView& view() const { return node.view(); }
  void tick() {
    now += std::chrono::milliseconds(1);
    commands.clear();
    if (!silent && now.time_since_epoch().count() % 5000000 == 0) {
      Received<MotionCommand> r;
      r.sequence = ++sequence;
      r.sent =
          PeerTime{now.time_since_epoch() - std::chrono::milliseconds(20) + std::chrono::milliseconds(777)};
      r.received = now;
      if (echo) r.echo_sent = now - std::chrono::milliseconds(40);
      r.message = command;
      goals_x.resize(sequence + 1, 0.0);
      goals_x[sequence] = command.position_m.x();
      if (!lost) {
        commands.push_back(r);
        last_heard = now;
      }
    }
    SlaveInput in;
    in.now = now;
    in.robot = arm.read(now);
    if (use_broken) in.robot = broken;
    if (sensor_fault) sensor_fault(in.robot);
    in.commands = commands;
    in.last_heard = last_heard;
    in.peer_session_count = last_heard ? sessions : 0;
    out = node.step(in);
    arm.write(out.joint_setpoint_rad);
    if (out.report) {
      last_report = out.report;
      ++reports;
      EXPECT_EQ(out.report_sequence, static_cast<std::uint64_t>(reports));
    }
    if (out.telemetry) ++telemetry;
    ASSERT_TRUE(!out.joint_setpoint_rad || out.joint_setpoint_rad->allFinite());
  }
  void run(double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds * 1e3));
    for (int i = 0; i < ticks; ++i) tick();
  }
  void engage(std::uint32_t number = 1) {
    run(0.1);
    command.engagement = number;
    command.request = Request::kEngage;
    run(0.1);
    ASSERT_TRUE(node.engaged());
  }
  // Moves the goal along x to `x` at `speed`.
  void move_to(double x, double speed) {
    while (std::abs(command.position_m.x() - x) > 1e-9) {
      const double left = x - command.position_m.x();
      command.position_m.x() += std::copysign(std::min(std::abs(left), speed * 1e-3), left);
      tick();
    }
  }
  double travelled() const { return (arm.true_pose().p - arm.start_pose().p).x(); }
};

}  // namespace longreach::test
