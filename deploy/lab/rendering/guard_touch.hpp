#pragma once
// The first touch, simulated at the slave only: the goal moves at a constant speed and keeps moving into an
// unknown wall for one round trip. The slave node commands a simulated gantry. The tool is either a mass that
// is coupled to the servo by a spring and a damper and yields to the wall, or (mass 0) it follows the servo
// rigidly, with the lag due to the bandwidth of the servo.

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <ostream>
#include <vector>

#include "deploy/lab/campaign_size.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"

namespace longreach::test {

enum class Then : std::uint8_t { kGoOn, kSilence, kStop };

struct GuardCase {
  double guard_n = 8.0;
  double delay_s = 4e-3;  // delay from sensing to setpoint, without the lag of the robot
  double deceleration_m_per_s2 = 1.25;
  double mass_kg = 10.0;  // 0: the tool follows its servo rigidly
  double servo_hz = 10.0;
  double round_trip_s = 3.0;  // round trip of the link; the goal continues into the wall for this duration
  double speed_m_per_s = 0.05;
  double wall_n_per_m = 5000.0;
  bool guarded = true;
  Then then = Then::kGoOn;
  double then_s = 1.0;  // time after the touch at which `then` takes effect
  std::uint64_t seed = 1;
};

/// The range of conditions that the force guard must support: all combinations of the limits and of some
/// values between them.
inline std::vector<GuardCase> guard_envelope() {
  std::vector<GuardCase> cases;
  for (const double guard_n : {8.0, 12.0, 20.0, 40.0}) {
    for (const double delay_s : {1e-3, 2e-3, 4e-3}) {
      for (const double deceleration : {1.25, 2.5, 5.0}) {
        for (const double mass_kg : {0.5, 1.0, 3.0, 10.0}) {
          for (const double servo_hz : {3.0, 6.0, 10.0, 20.0}) {
            for (const double round_trip_s : {0.0, 0.6, 3.0}) {
              cases.push_back({guard_n, delay_s, deceleration, mass_kg, servo_hz, round_trip_s});
              cases.back().seed = cases.size();
            }
          }
        }
      }
    }
  }
  return cases;
}

/// The whole grid if LONGREACH_FULL is set, otherwise every 29th case, so that every value of every factor is
/// included. The worst case is always included.
inline std::vector<GuardCase> guard_sample() {
  const std::vector<GuardCase> all = guard_envelope();
  std::vector<GuardCase> some;
  const std::size_t step = static_cast<std::size_t>(campaign(1, 29));
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  some.push_back({8.0, 4e-3, 5.0, 10.0, 3.0, 3.0});
  return some;
}

inline std::ostream& operator<<(std::ostream& out, const GuardCase& c) {
  return out << "guard " << c.guard_n << " N, " << c.delay_s << " s, " << c.deceleration_m_per_s2 << " m/s2, "
             << c.mass_kg << " kg, servo " << c.servo_hz << " Hz, round trip " << c.round_trip_s << " s, "
             << c.speed_m_per_s << " m/s on " << c.wall_n_per_m << " N/m, seed " << c.seed;
}

constexpr double kGuardWall_m = 0.03;  // distance of the wall from the start position of the tool
constexpr double kServoDamping = 0.7;  // damping ratio
constexpr double kWithoutGuard_n = 1e9;

inline SlaveConfig guard_config(const GuardCase& c) {
  SlaveConfig config;
  const double rate = 2.0 * std::numbers::pi * c.servo_hz;
  RobotConfig& robot = config.robot;
  robot.name = "gantry";
  for (JointConfig& j : robot.joint) j = {.min_rad = -2.0, .max_rad = 2.0, .kind = JointKind::kFixed};
  robot.joint[0].alpha_rad = -0.5 * std::numbers::pi;
  robot.joint[1].theta_rad = robot.joint[1].alpha_rad = 0.5 * std::numbers::pi;
  for (std::size_t i = 0; i < 3; ++i) {
    JointConfig& j = robot.joint[i];
    j.kind = JointKind::kPrismatic;
    j.speed_max_rad_per_s = 0.5;
    j.acceleration_max_rad_per_s2 = 2.0 * c.deceleration_m_per_s2;
    j.jerk_max_rad_per_s3 = 500.0 * j.acceleration_max_rad_per_s2;
    j.inertia_kg_m2 = c.mass_kg;
    j.stiffness_nm_per_rad = c.mass_kg * rate * rate;
    j.damping_nm_s_per_rad = 2.0 * kServoDamping * c.mass_kg * rate;
  }
  robot.servo_hz = c.mass_kg > 0.0 ? 0.0 : c.servo_hz;
  config.command.acceleration_max_m_per_s2 = c.deceleration_m_per_s2;
  config.command.force_guard_n = c.guarded ? c.guard_n : kWithoutGuard_n;
  config.scene.name = "wall";
  config.scene.material = {{"wall", c.wall_n_per_m, 1e-3, 1.0, 0.0}};
  config.scene.surface = {
      {"wall", "wall", PlaneConfig{Vector3(kGuardWall_m, 0, 0), -Vector3::UnitX(), true}}};
  return config;
}

struct GuardRow {
  double t_s, goal_m, tool_m, force_n;  // force_n: true force on the tool along x
};

struct GuardTouch {
  double touched_s = -1.0;
  double peak_n = 0.0;
  std::vector<GuardRow> rows{};  // one per tick
  SlaveView view{};              // at the end
};

constexpr double kPressed_s = 1.5;  // duration of the run after the touch

/// Generates the commands of the master, 200 per second.
class GuardCommands {
 public:
  explicit GuardCommands(const GuardCase& c) : case_(c) {}

  void step(SlaveInput& in, bool engaged, bool changed) {
    in.peer_session_count = 1;
    if (received_) in.last_heard = command_.received;
    if (in.now.time_since_epoch().count() % 5000000 != 0 || (changed && case_.then == Then::kSilence)) return;
    const double end_m = kGuardWall_m + 0.02 + case_.speed_m_per_s * case_.round_trip_s;
    if (engaged) goal_m_ = std::min(end_m, goal_m_ + 5e-3 * case_.speed_m_per_s);
    ++command_.sequence;
    command_.sent = PeerTime{in.now.time_since_epoch()};
    command_.received = in.now;
    if (received_) command_.echo_sent = in.now - from_seconds(case_.round_trip_s);
    command_.message.engagement = 1;
    command_.message.request = changed && case_.then == Then::kStop ? Request::kStop : Request::kEngage;
    command_.message.position_m.x() = goal_m_;
    received_ = true;
    in.commands = {&command_, 1};
    in.last_heard = in.now;
  }
  [[nodiscard]] double goal_m() const { return goal_m_; }

 private:
  GuardCase case_;
  Received<MotionCommand> command_{};
  double goal_m_ = 0.0;
  bool received_ = false;
};

inline GuardTouch guard_touch(const GuardCase& c) {
  const SlaveConfig config = guard_config(c);
  SlaveNode node(config);
  SimulatedArm arm(config, Random(c.seed));
  GuardCommands commands(c);
  std::deque<std::optional<JointVector>> way(
      static_cast<std::size_t>(std::max(0L, std::lround(c.delay_s * 1e3) - 1)), arm.read(Time{}).joint_rad);
  const double pressed_s = kPressed_s + (c.then == Then::kGoOn ? 0.0 : 2.0);
  GuardTouch seen;
  for (int i = 1; i < 20000; ++i) {
    const double t_s = 1e-3 * i;
    if (seen.touched_s >= 0.0 && t_s > seen.touched_s + pressed_s) break;
    SlaveInput in;
    in.now = Time{std::chrono::milliseconds(i)};
    in.robot = arm.read(in.now);
    commands.step(in, node.engaged(), seen.touched_s >= 0.0 && t_s > seen.touched_s + c.then_s);
    way.push_back(node.step(in).joint_setpoint_rad);
    arm.write(way.front());
    way.pop_front();
    const double force_n = -arm.true_wrench().force.x();
    if (seen.touched_s < 0.0 && force_n > 0.0) seen.touched_s = t_s;
    seen.peak_n = std::max(seen.peak_n, force_n);
    seen.rows.push_back({t_s, commands.goal_m(), (arm.true_pose().p - arm.start_pose().p).x(), force_n});
  }
  seen.view = node.view();
  return seen;
}

}  // namespace longreach::test
