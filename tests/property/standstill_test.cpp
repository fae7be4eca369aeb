// After the last valid command a robot at full speed stands still within
//   gap timer + 2 ticks + v/a + a/j
// whatever it was doing when the link died: v the tool's speed limit, a and j the robot's. Slave node and
// simulated arm in virtual time; what is judged are the setpoints. LONGREACH_FULL: 40 times as many.

#include <gtest/gtest.h>

#include <cstdio>
#include <deque>

#include "deploy/lab/campaign_size.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"
#include "tests/property/limited_arm.hpp"

namespace longreach::test::standstill_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kSpeed_m_per_s = 0.25;

struct Mover {
  std::string name;
  RobotConfig robot;
  double a = 0.0, j = 0.0;  // m/s^2, m/s^3 of the tool; as far as the joints' are not in the way
  double joints_s = 0.0;    // in which the joints brake from their speed limits, where that is longer
};

/// Three slides with these limits: what the tool does is what they do.
Mover slides(double a, double j) {
  Mover m{"slides", cartesian(), a, j};
  for (std::size_t i = 0; i < 3; ++i) {
    JointConfig& joint = m.robot.joint[i];
    joint.min_rad = -5.0;
    joint.max_rad = 5.0;
    joint.speed_max_rad_per_s = 1.0;
    joint.acceleration_max_rad_per_s2 = a;
    joint.jerk_max_rad_per_s3 = j;
  }
  return m;
}

Mover arm(const NamedArm& named) {
  Mover m{named.name, named.robot, CommandConfig{}.acceleration_max_m_per_s2, 0.0};
  double rise_s = 0.0;
  for (const JointConfig& j : m.robot.joint) {
    m.joints_s = std::max(m.joints_s, j.speed_max_rad_per_s / j.acceleration_max_rad_per_s2);
    rise_s = std::max(rise_s, j.acceleration_max_rad_per_s2 / j.jerk_max_rad_per_s3);
  }
  m.j = m.a / rise_s;
  return m;
}

/// What the master commands, and how its datagrams travel.
struct Moment {
  double send_hz = 200.0;
  double jitter_s = 0.0;
  Vector3 way = Vector3::UnitX(), turn = Vector3::UnitZ();  // unit
  double turn_rad_per_s = 0.0;
  double dies_s = 1.0;  // after the engagement
  double back_s = 1e9;  // the way is reversed so long before
  double wall_m = 1e9;  // a wall across the way
};

SlaveConfig config_of(const Mover& mover, const Moment& moment) {
  SlaveConfig config;
  config.robot = mover.robot;
  config.command.acceleration_max_m_per_s2 = mover.a;
  config.command.speed_max_m_per_s = kSpeed_m_per_s;
  config.command.workspace_m = 20.0;
  config.sensing.force = moment.wall_m < 10.0;  // without a wall, the speed is not limited in unknown space
  if (moment.wall_m < 10.0) {
    config.scene.name = "wall";
    config.scene.material = {{"wall", 2000.0, 1e-3, 1.0, 0.1}};
    config.scene.surface = {{"wall", "wall", PlaneConfig{moment.wall_m * moment.way, -moment.way, true}}};
  }
  return config;
}

struct Stop {
  double fastest_m_per_s = 0.0;  // before the end of the link
  double s = 0.0, way_m = 0.0;   // from the last command to standstill
  bool singular = false;         // it came next to a singular pose
  SlaveView view{};
};

/// The master's datagrams on their way.
class Sender {
 public:
  explicit Sender(const Moment& moment, Random& random) : moment_(moment), random_(random) {}

  void step(Time now, bool engaged, double t_s) {
    if (engaged) {
      const double sign = t_s > moment_.dies_s - moment_.back_s ? -1.0 : 1.0;
      goal_m_ += sign * kSpeed_m_per_s * kDt * moment_.way;
      turn_rad_ += sign * moment_.turn_rad_per_s * kDt;
    }
    phase_ += moment_.send_hz * kDt;
    while (phase_ >= 1.0) {
      phase_ -= 1.0;
      Received<MotionCommand> r;
      r.sequence = ++sequence_;
      r.sent = PeerTime{now.time_since_epoch()};
      r.received = now + from_seconds(moment_.jitter_s * random_.uniform());
      if (!flying_.empty()) r.received = std::max(r.received, flying_.back().received);
      r.echo_sent = now - std::chrono::milliseconds(5);
      r.message.engagement = 1;
      r.message.request = Request::kEngage;
      r.message.position_m = goal_m_;
      if (sequence_ % 2 == 0 && moment_.turn_rad_per_s > 0.0) {
        r.message.goal_kind = GoalKind::kGoalOrientation;
        r.message.rotation_rad = turn_rad_ * moment_.turn;
      }
      flying_.push_back(r);
    }
  }
  std::vector<Received<MotionCommand>> arrived(Time now) {
    std::vector<Received<MotionCommand>> all;
    while (!flying_.empty() && flying_.front().received <= now) {
      all.push_back(flying_.front());
      flying_.pop_front();
    }
    return all;
  }

 private:
  const Moment& moment_;
  Random& random_;
  Vector3 goal_m_ = Vector3::Zero();
  double turn_rad_ = 0.0;
  double phase_ = 1.0;
  std::uint64_t sequence_ = 0;
  std::deque<Received<MotionCommand>> flying_;
};

Stop stop_of(const Mover& mover, const Moment& moment, Random random) {
  const SlaveConfig config = config_of(mover, moment);
  SlaveNode node(config);
  SimulatedArm robot(config, random.child("arm"));
  const Kinematics kinematics(config.robot);
  Sender sender(moment, random);
  Stop stop;
  std::optional<Time> heard, engaged;
  Vector3 last_m = robot.start_pose().p, dead_m = last_m;
  for (Time now{}; now < Time{std::chrono::seconds(20)}; now += std::chrono::milliseconds(1)) {
    const double t_s = engaged ? to_seconds(now - *engaged) : 0.0;
    const bool dead = engaged && t_s > moment.dies_s;
    sender.step(now, engaged.has_value(), t_s);
    SlaveInput in;
    in.now = now;
    in.robot = robot.read(now);
    std::vector<Received<MotionCommand>> commands;
    if (!dead) commands = sender.arrived(now);
    if (!commands.empty()) heard = now;
    in.commands = commands;
    in.last_heard = heard;
    in.peer_session_count = 1;
    in.send_hz = moment.send_hz;
    const std::optional<JointVector> setpoint_rad = node.step(in).joint_setpoint_rad;
    robot.write(setpoint_rad);
    const JointVector q = setpoint_rad.value_or(in.robot.joint_rad);
    if (!engaged && node.engaged()) engaged = now;
    stop.singular |= node.view().clamps.singularity;
    const Vector3 p = kinematics.forward(q).p;
    // At a wall a hold eases the force: what counts is what goes into it.
    const bool wall = moment.wall_m < 10.0;
    const double speed = (wall ? std::max(0.0, moment.way.dot(p - last_m)) : (p - last_m).norm()) / kDt;
    last_m = p;
    if (!dead) stop.fastest_m_per_s = std::max(stop.fastest_m_per_s, speed), dead_m = p;
    if (dead && speed > 1e-6) stop.s = to_seconds(now - *heard), stop.way_m = (p - dead_m).norm();
    if (dead && to_seconds(now - *heard) > 3.0) break;
  }
  stop.view = node.view();
  return stop;
}

double gap_of(double send_hz) { return std::max(0.1, 30.0 / send_hz); }

double bound_s(const Mover& m, double send_hz) {
  return gap_of(send_hz) + 2.0 * kDt + std::max(kSpeed_m_per_s / m.a, m.joints_s) + m.a / m.j;
}

Vector3 unit(Random& random) {
  return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

Moment hostile(Random& random, double send_hz) {
  Moment m;
  m.send_hz = send_hz;
  m.way = unit(random);
  m.turn = unit(random);
  m.jitter_s = random.chance(0.5) ? random.uniform(0.0, 0.08) : 0.0;
  m.dies_s = random.uniform(0.1, 2.0);
  if (random.chance(0.5)) m.turn_rad_per_s = random.uniform(0.05, 0.3);
  if (random.chance(0.3)) m.back_s = random.uniform(0.0, 0.3);
  if (random.chance(0.3)) m.wall_m = random.uniform(0.05, 0.3);
  return m;
}

struct Worst {
  double share = 0.0, s = 0.0, way_m = 0.0, fastest_m_per_s = 0.0;
  void add(const Stop& stop, double bound_s) {
    share = std::max(share, stop.s / bound_s);
    s = std::max(s, stop.s);
    way_m = std::max(way_m, stop.way_m);
    fastest_m_per_s = std::max(fastest_m_per_s, stop.fastest_m_per_s);
  }
  void print(const char* what) const {
    std::printf("%s: at most %.3f s (%.2f of the bound), %.1f mm, from up to %.3f m/s\n", what, s, share,
                1e3 * way_m, fastest_m_per_s);
  }
};

TEST(Standstill, OfTheReadyArmsWhateverTheyWereDoing) {
  Random random(31);
  for (const NamedArm& named : limited_arms()) {
    const Mover mover = arm(named);
    Worst worst;
    for (int i = 0; i < campaign(600, 15); ++i) {
      const double send_hz = i % 3 == 0 ? 400.0 : 200.0;
      const Stop stop = stop_of(mover, hostile(random, send_hz), random.child(std::to_string(i)));
      EXPECT_LE(stop.s, bound_s(mover, send_hz)) << named.name << ' ' << i;
      EXPECT_EQ(stop.view.state, SafetyState::kHolding) << named.name << ' ' << i;
      worst.add(stop, bound_s(mover, send_hz));
    }
    worst.print(named.name.c_str());
  }
}

TEST(Standstill, JointsBrakeTogetherNearSingularPose) {
  Random random(34);
  Mover mover = arm(limited_arms()[1]);
  // The wrist nearly above the waist: small ways of the tool are long ways of the joints.
  const std::array<double, kMaxJoints> start_rad{0.0, 1.0, -0.6, 0.0, -0.6, 0.0};
  for (std::size_t i = 0; i < start_rad.size(); ++i) mover.robot.joint[i].start_rad = start_rad[i];
  Worst worst;
  int singular = 0;
  for (int i = 0; i < campaign(600, 15); ++i) {
    const Stop stop = stop_of(mover, hostile(random, 200.0), random.child(std::to_string(i)));
    EXPECT_LE(stop.s, bound_s(mover, 200.0) + mover.joints_s) << i;
    EXPECT_EQ(stop.view.state, SafetyState::kHolding) << i;
    worst.add(stop, bound_s(mover, 200.0));
    singular += stop.singular ? 1 : 0;
  }
  EXPECT_GT(singular, campaign(600, 15) / 2);
  worst.print("puma560 next to a singular pose");
}

TEST(Standstill, OfSwiftRobotsWithinTwoTenthsOfASecond) {
  Random random(32);
  Worst worst, standard;
  for (int i = 0; i < campaign(2000, 50); ++i) {
    const double share = random.uniform();
    const Mover mover =
        i % 5 == 0 ? slides(5.0, 200.0) : slides(5.0 + 15.0 * share, 200.0 * (1.0 + 20.0 * random.uniform()));
    const Moment fast = hostile(random, i % 2 == 0 ? 300.0 : 1000.0);
    const Stop stop = stop_of(mover, fast, random.child(std::to_string(i)));
    EXPECT_LE(stop.s, std::min(bound_s(mover, 300.0), 0.2)) << i << " a " << mover.a << " j " << mover.j;
    EXPECT_EQ(stop.view.limit_violations, 0U) << i;
    worst.add(stop, bound_s(mover, 300.0));
    const Stop usual = stop_of(mover, hostile(random, 200.0), random.child(std::to_string(i)));
    EXPECT_LE(usual.s, bound_s(mover, 200.0)) << i;
    standard.add(usual, bound_s(mover, 200.0));
  }
  worst.print("a >= 5, j >= 200, 300 Hz or more");
  standard.print("a >= 5, j >= 200, 200 Hz");
}

TEST(Standstill, LargeArmStopsInSevenTenthsOfASecond) {
  Random random(33);
  Worst worst, standard;
  for (int i = 0; i < campaign(800, 20); ++i) {
    const Mover mover = slides(0.5, i % 3 == 0 ? 10.0 : random.uniform(10.0, 100.0));
    const Stop stop =
        stop_of(mover, hostile(random, i % 2 == 0 ? 300.0 : 1000.0), random.child(std::to_string(i)));
    EXPECT_LE(stop.s, std::min(bound_s(mover, 300.0), 0.7)) << i << " j " << mover.j;
    EXPECT_LE(stop.way_m, 0.1) << i << " j " << mover.j;
    EXPECT_EQ(stop.view.limit_violations, 0U) << i;
    worst.add(stop, bound_s(mover, 300.0));
    const Stop usual = stop_of(mover, hostile(random, 200.0), random.child(std::to_string(i)));
    EXPECT_LE(usual.s, bound_s(mover, 200.0)) << i << " j " << mover.j;
    standard.add(usual, bound_s(mover, 200.0));
  }
  worst.print("a = 0.5, j >= 10, 300 Hz or more");
  standard.print("a = 0.5, j >= 10, 200 Hz");
}

}  // namespace
}  // namespace longreach::test::standstill_test
