// The moment guard at a first contact by rotation: arms, levers, stops, speeds and loop delays at random,
// through the slave's node and the simulated arm. With stiffness k, speed w, deceleration a and the time t_d
// from the moment to the tool, a guard of G holds
//   M <= G + max(0.35 G, k (w t_d + w²/(2 a)))
// so M <= 1.35 G up to 390 N m/rad at 0.1 rad/s and 60 N m/rad at 0.3 rad/s.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <deque>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/robot/random_arm.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"

namespace longreach::test::moment_guard_test {
namespace {

constexpr double kMomentOvershoot = 0.35, kReact_s = 0.02, kStopRad = 0.03;

struct TurnCase {
  int arm = 0;
  double guard_nm = 5.0;
  double stop_nm_per_rad = 10.0;
  double lever_m = 0.1;
  double speed_rad_per_s = 0.1;
  int delay_ticks = 1;
  bool guarded = true;
  std::uint64_t seed = 1;

  [[nodiscard]] double formula_nm() const {
    const double w = speed_rad_per_s, a = CommandConfig{}.acceleration_max_rad_per_s2;
    return stop_nm_per_rad * (w * kReact_s + 0.5 * w * w / a);
  }
  /// Far enough, and in time: against a soft stop √(2 a (G - M)/k_max) makes the last of the way slow.
  [[nodiscard]] bool pressed_to_the_guard() const {
    const double a = CommandConfig{}.acceleration_max_rad_per_s2;
    const double slow_s = std::sqrt(2.0 * guard_nm * kGuardStiffness_nm_per_rad / a) / stop_nm_per_rad;
    return stop_nm_per_rad * 2.0 * speed_rad_per_s > 1.2 * guard_nm && slow_s < 0.8;
  }
  [[nodiscard]] bool inside() const { return formula_nm() <= kMomentOvershoot * guard_nm; }
};

std::ostream& operator<<(std::ostream& out, const TurnCase& c) {
  return out << "arm " << c.arm << ", guard " << c.guard_nm << " N m, " << c.stop_nm_per_rad
             << " N m/rad at a lever of " << c.lever_m << " m, " << c.speed_rad_per_s << " rad/s, "
             << c.delay_ticks << " ticks, seed " << c.seed;
}

RobotConfig placed(int arm) {
  RobotConfig robot = ready_arms()[static_cast<std::size_t>(arm)].limited;
  constexpr double kStart_rad[3][kMaxJoints] = {{0.0, 1.0472, -1.5708, 0.5236, 0.0, 0.0},
                                                {0.0, 0.7854, -3.1416, 0.0, 0.7854, 0.0},
                                                {0.0, -1.2, 1.6, -1.97, -1.57, 0.0}};
  for (std::size_t i = 0; i < kMaxJoints; ++i) robot.joint[i].start_rad = kStart_rad[arm][i];
  return robot;
}

SlaveConfig turn_config(const TurnCase& c) {
  SlaveConfig config;
  config.robot = placed(c.arm);
  config.robot.servo_hz = 20.0;
  config.command.moment_guard_nm = c.guarded ? c.guard_nm : 1e6;
  config.scene.name = "stop";
  config.scene.material = {{"stop", c.stop_nm_per_rad / (c.lever_m * c.lever_m), 1e-3, 1.0, 0.1}};
  config.scene.surface = {{"stop", "stop"}};
  config.scene.surface[0].hinge = HingeConfig{.angle_rad = kStopRad, .arm_m = c.lever_m};
  return config;
}

struct TurnSeen {
  double peak_nm = 0.0, last_nm = 0.0;
  SlaveView view{};
};

/// Turns on and on about the stop's axis for two seconds after it is met.
TurnSeen turn_into(const TurnCase& c) {
  const SlaveConfig config = turn_config(c);
  SlaveNode node(config);
  SimulatedArm arm(config, Random(c.seed));
  std::deque<std::optional<JointVector>> way(static_cast<std::size_t>(c.delay_ticks - 1),
                                             arm.read(Time{}).joint_rad);
  Received<MotionCommand> command;
  command.message.goal_kind = GoalKind::kGoalOrientation;
  command.message.engagement = 1;
  command.message.request = Request::kEngage;
  TurnSeen seen;
  const int ticks = 500 + static_cast<int>(1e3 * (kStopRad / c.speed_rad_per_s + 2.0));
  for (int i = 1; i < ticks; ++i) {
    SlaveInput in;
    in.now = Time{std::chrono::milliseconds(i)};
    in.robot = arm.read(in.now);
    in.peer_session_count = 1;
    if (i % 5 == 0) {
      if (node.engaged()) command.message.rotation_rad.z() += 5e-3 * c.speed_rad_per_s;
      ++command.sequence;
      command.sent = PeerTime{in.now.time_since_epoch()};
      if (i > 5) command.echo_sent = in.now;
      command.received = in.now;
      in.commands = {&command, 1};
    }
    if (i >= 5) in.last_heard = command.received;
    way.push_back(node.step(in).joint_setpoint_rad);
    arm.write(way.front());
    way.pop_front();
    seen.last_nm = arm.true_wrench().moment.norm();
    seen.peak_nm = std::max(seen.peak_nm, seen.last_nm);
  }
  seen.view = node.view();
  return seen;
}

TurnCase draw(Random& random, int i) {
  const auto spread = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
  TurnCase c;
  c.arm = static_cast<int>(random.uniform(0.0, 3.0));
  c.guard_nm = spread(1.0, 10.0);
  c.stop_nm_per_rad = spread(3.0, 1000.0);
  c.lever_m = spread(0.02, 0.5);
  c.speed_rad_per_s = spread(0.02, 0.25);
  c.delay_ticks = 1 + static_cast<int>(random.uniform(0.0, 4.0));
  c.seed = static_cast<std::uint64_t>(i) + 1;
  return c;
}

TEST(MomentGuardProperty, HoldsFirstContactInsideEnvelope) {
  Random random(44);
  int inside = 0, outside = 0, pressed = 0;
  double worst = 0.0, worst_outside = 0.0;
  for (int i = 0; i < campaign(3000, 150); ++i) {
    const TurnCase c = draw(random, i);
    const TurnSeen seen = turn_into(c);
    const double over_nm = std::max(kMomentOvershoot * c.guard_nm, c.formula_nm());
    EXPECT_LE(seen.peak_nm, c.guard_nm + over_nm) << c;
    EXPECT_LE(seen.last_nm, 1.05 * c.guard_nm) << c;
    EXPECT_TRUE(seen.view.in_contact) << c;
    EXPECT_EQ(seen.view.limit_violations, 0U) << c;
    EXPECT_EQ(seen.view.state, SafetyState::kEngaged) << c;
    if (c.pressed_to_the_guard()) {
      EXPECT_GT(seen.last_nm, 0.9 * c.guard_nm) << c;
      ++pressed;
    }
    double& most = c.inside() ? worst : worst_outside;
    most = std::max(most, seen.peak_nm / (c.inside() ? c.guard_nm : c.guard_nm + over_nm));
    ++(c.inside() ? inside : outside);
  }
  std::printf("moment guard: at most %.2f of the guard in %d cells, %.2f of the formula in %d\n", worst,
              inside, worst_outside, outside);
  EXPECT_GT(inside, campaign(1000, 50));
  EXPECT_GT(outside, campaign(300, 15));
  EXPECT_GT(pressed, campaign(1000, 50));
}

TEST(MomentGuardProperty, WithoutItTheSameContactsTurnOn) {
  Random random(44);
  int far = 0;
  for (int i = 0; i < campaign(300, 40); ++i) {
    TurnCase c = draw(random, i);
    if (c.stop_nm_per_rad * 2.0 * c.speed_rad_per_s < 3.0 * c.guard_nm) continue;
    c.guarded = false;
    EXPECT_GT(turn_into(c).peak_nm, 1.35 * c.guard_nm) << c;
    ++far;
  }
  EXPECT_GT(far, campaign(100, 13));
}

}  // namespace
}  // namespace longreach::test::moment_guard_test
