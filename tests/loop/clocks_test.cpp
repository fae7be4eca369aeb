// Time is what passed: sides that stood still, and a host that was suspended; in virtual time.
// LONGREACH_FULL: 2000 freezes.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "common/loop/real_time_loop.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::clocks::clocks_test {
namespace {

using State = SafetyState;
using Cause = HoldCause;

/// Setpoints from one to the next, by the nominal period, against the limits of the robot's file: by their
/// differences, not by what the slave says of itself.
class BlackBox {
 public:
  explicit BlackBox(const Bench& bench)
      : robot_(bench.slave.robot), kinematics_(robot_), dt_s_(1.0 / bench.slave.loop.rate_hz) {}

  /// `tool_m`: where the tool truly is.
  void see(const std::optional<JointVector>& setpoint_rad, const Vector3& tool_m) {
    if (setpoint_rad && rests_) begin(*setpoint_rad, tool_m);
    if (setpoint_rad) see(*setpoint_rad);
    rests_ = !setpoint_rad;
  }
  /// Of the tool, by the newest setpoint, m.
  [[nodiscard]] double step_m() const { return step_m_; }
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;  // worst, as multiples of the limit
  double begin_m = 0.0;                                // worst: of a first setpoint off the tool

 private:
  void begin(const JointVector& setpoint_rad, const Vector3& tool_m) {
    begin_m = std::max(begin_m, (kinematics_.forward(setpoint_rad).p - tool_m).norm());
    last_ = setpoint_rad;
    v_.setZero(), a_.setZero();
    seen_ = kSettled;
  }
  void see(const JointVector& setpoint_rad) {
    if (seen_++ > 0 && setpoint_rad == last_) return rest();
    const JointVector v = (setpoint_rad - last_) / dt_s_, a = (v - v_) / dt_s_, j = (a - a_) / dt_s_;
    if (seen_ > kSettled) judge(v, a, j);
    step_m_ = (kinematics_.forward(setpoint_rad).p - kinematics_.forward(last_).p).norm();
    last_ = setpoint_rad, v_ = v, a_ = a;
  }
  void rest() {
    const JointVector a = -v_ / dt_s_, j = (a - a_) / dt_s_;
    if (seen_ > kSettled) judge(JointVector::Zero(), a, j);
    v_.setZero(), a_ = a, step_m_ = 0.0;
  }
  void judge(const JointVector& v, const JointVector& a, const JointVector& j) {
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& limit = robot_.joint[static_cast<std::size_t>(i)];
      speed = std::max(speed, std::abs(v[i]) / limit.speed_max_rad_per_s);
      acceleration = std::max(acceleration, std::abs(a[i]) / limit.acceleration_max_rad_per_s2);
      jerk = std::max(jerk, std::abs(j[i]) / limit.jerk_max_rad_per_s3);
    }
  }

  static constexpr int kSettled = 4;  // setpoints after which all differences are known

  RobotConfig robot_;
  Kinematics kinematics_;
  double dt_s_;
  int seen_ = 0;
  bool rests_ = false;  // nothing was commanded before
  double step_m_ = 0.0;
  JointVector last_ = JointVector::Zero(), v_ = JointVector::Zero(), a_ = JointVector::Zero();
};

struct Freeze {
  bool slave, master;
  double seconds;
  bool contact;
  double delay_s;
};

std::ostream& operator<<(std::ostream& out, const Freeze& f) {
  return out << (f.slave ? "slave " : "") << (f.master ? "master " : "") << f.seconds << " s"
             << (f.contact ? ", in contact" : ", free") << ", delay " << f.delay_s << " s";
}

Bench bench_for(const Freeze& f) {
  const std::string delay = std::to_string(f.delay_s);
  std::vector<std::string> settings{"profile=lab", "master.link.impairment.delay_s=" + delay,
                                    "slave.link.impairment.delay_s=" + delay};
  if (f.contact) {
    settings.insert(settings.end(), {"scene.material.wall.stiffness_n_per_m=2000",
                                     "scene.surface.wall.plane.point_m=0.01,0,0", "mapping.mode=POSITION",
                                     "mapping.scale=1"});
  } else {
    settings.insert(settings.end(), {"scene_file=scenes/free.txtpb", "mapping.mode=RATE"});
  }
  return Bench(settings);
}

/// Moves at speed, or presses.
void work(Laboratory& lab, const Freeze& f) {
  HandTarget hand;
  lab.drive(hand);
  run(lab, 0.5 + 4.0 * f.delay_s);
  ASSERT_TRUE(engage(lab, 1.0 + 4.0 * f.delay_s)) << f;
  for (int i = 1; i <= 500; ++i) {
    hand.position_m = {(f.contact ? 0.02 : 0.05) * i / 500.0, 0.0, 0.0};
    lab.drive(hand);
    lab.step();
  }
  run(lab, 0.5 + 4.0 * f.delay_s);
  ASSERT_TRUE(both(lab, State::kEngaged)) << f;
  if (f.contact) {
    ASSERT_GT(lab.arm().true_wrench().force.norm(), 1.0) << f;
  } else {
    ASSERT_GT(lab.arm().true_velocity().norm(), 0.03) << f;
  }
}

struct Worst {
  double speed = 0.0, acceleration = 0.0, jerk = 0.0, engaging_m = 0.0;
  int holds = 0, went_on = 0;
};

/// Lets the frozen sides stand still, and judges what follows: a longer freeze than resume_s ends the
/// engagement, and no setpoint steps.
void judge(const Freeze& f, Worst& worst) {
  Bench bench = bench_for(f);
  Laboratory& lab = *bench.lab;
  work(lab, f);
  if (testing::Test::HasFatalFailure()) return;
  BlackBox box(bench);
  for (int i = 0; i < 10; ++i) {
    lab.step();
    box.see(lab.setpoint_rad(), lab.arm().true_pose().p);
  }
  if (f.slave) lab.freeze_slave(f.seconds);
  if (f.master) lab.freeze_master(f.seconds);
  for (const double end_s = lab.now_s() + f.seconds; lab.now_s() < end_s;) {
    const std::optional<JointVector> before = lab.setpoint_rad();
    lab.step();
    if (!f.slave || lab.setpoint_rad() != before) box.see(lab.setpoint_rad(), lab.arm().true_pose().p);
  }
  const bool long_enough = f.seconds > 1.0 + 0.01;
  bool held = false, engaged_by_itself = false;
  for (const double end_s = lab.now_s() + 3.0 + 4.0 * f.delay_s; lab.now_s() < end_s;) {
    const bool rested = lab.slave().state != State::kEngaged;
    lab.step();
    box.see(lab.setpoint_rad(), lab.arm().true_pose().p);
    held = held || lab.slave().state == State::kHolding;
    engaged_by_itself = engaged_by_itself || (held && lab.slave().state == State::kEngaged);
    if (rested && lab.slave().state == State::kEngaged)
      worst.engaging_m = std::max(worst.engaging_m, box.step_m());
  }
  EXPECT_EQ(lab.slave().engagement, 1U) << f;
  if (f.seconds > 0.11) {
    EXPECT_TRUE(held) << f;
  }
  if (f.seconds < 0.09) {
    EXPECT_FALSE(held) << f;
  }
  if (long_enough) {
    EXPECT_FALSE(engaged_by_itself) << f;
    EXPECT_TRUE(both(lab, State::kHolding)) << f;
    ASSERT_TRUE(engage(lab, 1.0 + 4.0 * f.delay_s)) << f;
  }
  worst.speed = std::max(worst.speed, box.speed);
  worst.acceleration = std::max(worst.acceleration, box.acceleration);
  worst.jerk = std::max(worst.jerk, box.jerk);
  worst.engaging_m = std::max(worst.engaging_m, box.begin_m);
  worst.holds += held;
  worst.went_on += engaged_by_itself;
}

TEST(Clocks, AFreezeIsAHoldAndALongOneEndsTheEngagement) {
  Random random(9);
  Worst worst;
  const int count = campaign(2000, 24);
  for (int i = 0; i < count; ++i) {
    const int who = i % 3;
    const double seconds = 0.01 * std::pow(6000.0, random.uniform());
    judge({who != 1, who != 0, seconds, random.chance(0.5), random.chance(0.3) ? 0.3 : 0.002}, worst);
    if (HasFailure()) FAIL() << "freeze " << i;
  }
  std::printf(
      "%d freezes, %d holds of which %d went on within resume_s; of the limits: speed %.3f, acceleration "
      "%.3f, "
      "jerk %.3f; %.2e m when engaged again\n",
      count, worst.holds, worst.went_on, worst.speed, worst.acceleration, worst.jerk, worst.engaging_m);
  EXPECT_LE(worst.speed, 1.0 + 1e-6);
  EXPECT_LE(worst.acceleration, 1.0 + 1e-6);
  EXPECT_LE(worst.jerk, 1.0 + 1e-6);
  EXPECT_LE(worst.engaging_m, 1e-4);
  EXPECT_GT(worst.holds, count / 4);
  EXPECT_GT(worst.went_on, 0);
}

TEST(Clocks, BothSidesFrozenForEightSecondsDoNotMoveByThemselves) {
  const Freeze f{true, true, 8.0, false, 0.002};
  Bench bench = bench_for(f);
  Laboratory& lab = *bench.lab;
  work(lab, f);
  lab.freeze_slave(f.seconds);
  lab.freeze_master(f.seconds);
  run(lab, f.seconds + 0.001);
  EXPECT_EQ(lab.slave().cause, Cause::kStalled);
  EXPECT_EQ(lab.master().cause, Cause::kStalled);
  run(lab, 1.0);
  const Vector3 at_m = lab.arm().true_pose().p;
  for (int i = 0; i < 20000; ++i) {
    lab.step();
    ASSERT_TRUE(both(lab, State::kHolding)) << i;
  }
  EXPECT_LT((lab.arm().true_pose().p - at_m).norm(), 1e-5);
}

TEST(Clocks, AStopThatLayInTheSocketIsObeyed) {
  const Freeze f{true, false, 3.0, false, 0.002};
  Bench bench = bench_for(f);
  Laboratory& lab = *bench.lab;
  work(lab, f);
  lab.freeze_slave(f.seconds);
  run(lab, 0.5);
  lab.requests().stop = true;
  run(lab, 0.1);
  EXPECT_EQ(lab.slave().state, State::kEngaged) << "it knows nothing yet";
  run(lab, f.seconds - 0.6 + 0.002);
  EXPECT_EQ(lab.slave().state, State::kStopped);
}

TEST(Clocks, ARobotThatWasMovedMeanwhileIsNotCalledBack) {
  const Freeze f{true, false, 5.0, false, 0.002};
  Bench bench = bench_for(f);
  Laboratory& lab = *bench.lab;
  lab.drive({});
  run(lab, 0.5);
  ASSERT_TRUE(engage(lab, 1.0));
  run(lab, 1.0);
  lab.freeze_slave(f.seconds);
  run(lab, 1.0);
  JointVector q = *lab.setpoint_rad();
  for (int i = 0; i < 200; ++i) {
    q[1] += 1e-3;
    lab.arm().displace(q);
    lab.step();
  }
  run(lab, 1.0);
  const Vector3 at_m = lab.arm().true_pose().p;
  for (int i = 0; i < 10000; ++i) {
    lab.step();
    ASSERT_LT((lab.arm().true_pose().p - at_m).norm(), 1e-3) << i;
  }
  EXPECT_EQ(lab.slave().state, State::kFault);
  EXPECT_EQ(lab.slave().cause, Cause::kTrackingLost);
}

TEST(Clocks, HalfOfTheTicksLateIsAnOverrun) {
  for (const int runs_of_ten : {6, 4}) {
    for (const bool slave : {true, false}) {
      const Freeze f{slave, !slave, 0.0, false, 0.002};
      Bench bench = bench_for(f);
      Laboratory& lab = *bench.lab;
      work(lab, f);
      for (int i = 0; i < 3000; ++i) {
        if (i % 10 >= runs_of_ten) slave ? lab.freeze_slave(1e-3) : lab.freeze_master(1e-3);
        lab.step();
      }
      const Cause cause = slave ? lab.slave().cause : lab.master().cause;
      EXPECT_EQ(cause, runs_of_ten < 5 ? Cause::kOverrun : Cause::kNone) << runs_of_ten << slave;
    }
  }
}

/// The host that a loop runs on: it sleeps when it is told to, and then its clock has gone on.
struct Host {
  static inline Duration now{std::chrono::seconds(5000)};
  static inline Duration suspended{0};  // in the next sleep
  static Time read() { return Time{now}; }
  static void sleep(Time deadline) {
    now = std::max(now, deadline.time_since_epoch()) + std::exchange(suspended, Duration{0});
  }
};

TEST(Clocks, TheTimeThatTheHostWasSuspendedHasPassed) {
  const SlaveConfig config = to_struct(configure({"scene_file=scenes/free.txtpb"}, LONGREACH_DEPLOY).slave());
  SlaveNode node(config);
  SimulatedArm arm(config, Random(1));
  Received<MotionCommand> command;
  command.message = {.engagement = 1, .request = Request::kEngage};
  std::atomic<bool> stop{false};
  RealTimeLoop loop(config.loop.rate_hz, {Host::read, Host::sleep});
  std::uint64_t missed = 0;
  loop.run(stop, [&](Time now, const LoopFigures& figures) {
    if (figures.ticks == 1000) {
      EXPECT_EQ(node.view().state, State::kEngaged);
      Host::suspended = std::chrono::seconds(60);
    }
    SlaveInput in;
    in.now = now;
    in.robot = arm.read(now);
    in.peer_session_count = 1;
    in.last_heard = command.received = now;  // as if it had come just now
    command.echo_sent = now;
    command.sent = PeerTime{now.time_since_epoch()};
    ++command.sequence;
    in.commands = {&command, 1};
    in.overdue_ticks = figures.overdue_ticks;
    arm.write(node.step(in).joint_setpoint_rad);
    missed = figures.missed_ticks;
    stop = figures.ticks == 3000;
  });
  EXPECT_EQ(node.view().state, State::kHolding);
  EXPECT_EQ(node.view().cause, Cause::kStalled);
  EXPECT_NEAR(static_cast<double>(missed), 60000.0, 10.0);
}

}  // namespace
}  // namespace longreach::clocks::clocks_test
