// Goals that go anywhere: straight through singular poses or close by, out of reach and back, in jumps, away
// for a while. The setpoints are judged from outside, by their differences. LONGREACH_FULL: 10,000 paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "slave/motion.hpp"
#include "tests/property/campaign.hpp"
#include "tests/property/limited_arm.hpp"

namespace longreach {
namespace {

constexpr double kDt = 1e-3;
constexpr double kSettleS = 120.0;  // at most, after the goal has come to rest

struct Worst {
  double position = 0.0;                               // rad beyond a limit
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;  // share of the limit
  double tool_m_per_s = 0.0, tool_rad_per_s = 0.0;
};

// Differences of the setpoints against the limits of the joints.
class Judge {
 public:
  Judge(const RobotConfig& robot, const JointVector& q) : robot_(robot), q_(q) {}

  void see(const JointVector& q, Worst& worst) {
    const JointVector v = (q - q_) / kDt, a = (v - v_) / kDt, jerk = (a - a_) / kDt;
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
      worst.position = std::max({worst.position, q[i] - j.max_rad, j.min_rad - q[i]});
      worst.speed = std::max(worst.speed, std::abs(v[i]) / j.speed_max_rad_per_s);
      worst.acceleration = std::max(worst.acceleration, std::abs(a[i]) / j.acceleration_max_rad_per_s2);
      worst.jerk = std::max(worst.jerk, std::abs(jerk[i]) / j.jerk_max_rad_per_s3);
    }
    q_ = q, v_ = v, a_ = a;
  }

 private:
  const RobotConfig& robot_;
  JointVector q_, v_ = JointVector::Zero(), a_ = JointVector::Zero();
};

JointVector inside(const RobotConfig& robot, const JointVector& q, double margin_rad) {
  JointVector result;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    result[i] = std::clamp(q[i], j.min_rad + margin_rad, j.max_rad - margin_rad);
  }
  return result;
}

JointVector anywhere(const RobotConfig& robot, Random& random) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    q[i] = random.uniform(j.min_rad + 0.1, j.max_rad - 0.1);
  }
  return q;
}

JointVector spread(Random& random, double size) {
  JointVector q;
  for (double& x : q) x = size * random.uniform(-1.0, 1.0);
  return q;
}

// From pose to pose along a straight line and about one axis, at a steady pace.
struct Leg {
  Pose from, to;
  double seconds;

  [[nodiscard]] Pose at(double share) const {
    const Vector3 turn = log_rotation(to.q * from.q.conjugate());
    return {from.p + share * (to.p - from.p), exp_rotation(share * turn) * from.q};
  }
};

double seconds_for(const Pose& a, const Pose& b, const CommandConfig& command, double pace) {
  return std::max((b.p - a.p).norm() / command.speed_max_m_per_s,
                  a.q.angularDistance(b.q) / command.speed_max_rad_per_s) /
             pace +
         0.1;
}

enum Kind : std::size_t { kSingular, kBeside, kOutOfReach, kJumps, kLimits };
constexpr std::array<const char*, 5> kNames{"through singular", "beside singular", "out of reach", "jumps",
                                            "joint limits"};

struct Tour {
  JointVector start;
  std::vector<Leg> legs;
  bool jumps = false;
};

// Where the determinant of J has a zero between two joints of the range, of joint `i`.
bool make_singular(const Kinematics& kinematics, const RobotConfig& robot, int i, JointVector& q) {
  const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
  const auto determinant = [&](double x) {
    JointVector at = q;
    at[i] = x;
    return kinematics.rigid_with_jacobian(at).J.determinant();
  };
  for (double low = j.min_rad + 0.15; low + 0.05 < j.max_rad - 0.15; low += 0.05) {
    double a = low, b = low + 0.05;
    const bool sign = determinant(a) < 0.0;
    if ((determinant(b) < 0.0) == sign) continue;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (a + b);
      ((determinant(middle) < 0.0) == sign ? a : b) = middle;
    }
    q[i] = a;
    return true;
  }
  return false;
}

Tour make_tour(Kind kind, const RobotConfig& robot, const Kinematics& kinematics,
               const CommandConfig& command, Random& random) {
  Tour tour;
  JointVector middle = anywhere(robot, random);
  if (kind == kSingular || kind == kBeside) {
    for (int n = 0; n < 30; ++n) {
      middle = anywhere(robot, random);
      if (make_singular(kinematics, robot, 1 + static_cast<int>(random.next() % 4), middle)) break;
    }
  }
  const double far = kinematics.reach_m() > 5.0 ? 0.05 : 0.2;
  const JointVector way = spread(random, kind == kLimits ? 10.0 * far : far);
  tour.start = inside(robot, middle - way, 0.02);
  const JointVector end = inside(robot, middle + way, kind == kLimits ? 0.0 : 0.02);
  Pose via = kinematics.forward(middle);
  if (kind == kBeside) via.p += std::pow(10.0, random.uniform(-12.0, -2.0)) * Vector3(0.6, -0.64, 0.48);
  if (kind == kOutOfReach) via.p = via.p.normalized() * kinematics.reach_m() * random.uniform(1.05, 1.5);
  const Pose first = kinematics.forward(tour.start);
  const Pose last = kind == kOutOfReach ? first : kinematics.forward(end);
  const double pace = random.uniform(0.3, 1.2);
  const auto add = [&](const Pose& a, const Pose& b) {
    tour.legs.push_back({a, b, std::min(seconds_for(a, b, command, pace), 30.0)});
  };
  add(first, via);
  add(via, last);
  tour.jumps = kind == kJumps;
  return tour;
}

struct Outcome {
  double off_m = 0.0;  // of the tool from the goal's way
  bool arrived = false;
  double arrived_s = 0.0;   // after the goal came to rest
  double blocked_s = -1.0;  // after the goal came to rest, when last told that the arm is in its own way
  double silent_m = 0.0, silent_rad = 0.0;  // of the tool from its goal while nothing was told
};

double off_the_way(const Tour& tour, const Vector3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Leg& leg : tour.legs) {
    const Vector3 d = leg.to.p - leg.from.p;
    const double share = std::clamp(d.dot(p - leg.from.p) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
    least = std::min(least, (leg.from.p + share * d - p).norm());
  }
  return least;
}

// A robot on one tour, judged at every tick.
struct Drive {
  Drive(const RobotConfig& robot, const CommandConfig& command, const Tour& on)
      : motion(command, robot), tour(on), judge(robot, on.start) {
    motion.reset(on.start);
    before = motion.X_WE();
  }

  void tick(const std::optional<Pose>& goal) {
    const Clamps c = motion.step({goal, {}, kDt});
    blocked = c.unreachable || c.joint_position || c.singularity;
    judge.see(motion.joint_setpoint_rad(), worst);
    const Pose& X = motion.X_WE();
    outcome.off_m = std::max(outcome.off_m, off_the_way(tour, X.p));
    if (goal && !(blocked || c.tool_speed || c.joint_speed || c.workspace)) {
      outcome.silent_m = std::max(outcome.silent_m, (X.p - goal->p).norm());
      outcome.silent_rad = std::max(outcome.silent_rad, log_rotation(X.q * goal->q.conjugate()).norm());
    }
    worst.tool_m_per_s = std::max(worst.tool_m_per_s, (X.p - before.p).norm() / kDt);
    worst.tool_rad_per_s = std::max(worst.tool_rad_per_s, X.q.angularDistance(before.q) / kDt);
    before = X;
  }

  void follow(Random& random) {
    for (const Leg& leg : tour.legs) {
      std::optional<Pose> goal = leg.from;
      for (double t = 0.0; t < leg.seconds; t += kDt) {
        if (!tour.jumps) goal = leg.at(t / leg.seconds);
        if (tour.jumps && random.chance(0.005)) goal = leg.at(random.uniform());
        if (tour.jumps && random.chance(0.001)) goal.reset();
        tick(goal);
      }
    }
  }

  void settle() {
    constexpr double kThere = 1e-9;
    const Pose& last = tour.legs.back().to;
    for (double t = 0.0; t < kSettleS && !outcome.arrived; t += kDt) {
      tick(last);
      outcome.arrived_s = t;
      if (blocked) outcome.blocked_s = t;
      outcome.arrived = (before.p - last.p).norm() <= kThere &&
                        log_rotation(before.q * last.q.conjugate()).norm() <= kThere;
    }
  }

  SlaveMotion motion;
  const Tour& tour;
  Judge judge;
  Pose before{};
  Worst worst{};
  Outcome outcome{};
  bool blocked = false;  // in the last tick
};

struct Summary {
  int arrived = 0;
  std::vector<double> arrived_s, off;  // off: share of the reach
  Worst worst{};

  void add(const Drive& drive, double reach_m) {
    if (drive.outcome.arrived) ++arrived, arrived_s.push_back(drive.outcome.arrived_s);
    off.push_back(drive.outcome.off_m / reach_m);
    worst.speed = std::max(worst.speed, drive.worst.speed);
    worst.acceleration = std::max(worst.acceleration, drive.worst.acceleration);
    worst.jerk = std::max(worst.jerk, drive.worst.jerk);
    worst.tool_m_per_s = std::max(worst.tool_m_per_s, drive.worst.tool_m_per_s);
    worst.tool_rad_per_s = std::max(worst.tool_rad_per_s, drive.worst.tool_rad_per_s);
  }

  static double quantile(std::vector<double> x, double share) {
    if (x.empty()) return 0.0;
    std::sort(x.begin(), x.end());
    return x[static_cast<std::size_t>(share * static_cast<double>(x.size() - 1))];
  }

  void print(const std::string& name) const {
    std::printf(
        "%s: %d of %zu arrived, after %.2f s (median), %.2f s (last); off the way %.1e, at most %.1e of the "
        "reach; of the joint limits %.4f speed, %.4f acceleration, %.4f jerk; tool %.3f m/s, %.3f rad/s\n",
        name.c_str(), arrived, off.size(), quantile(arrived_s, 0.5), quantile(arrived_s, 1.0),
        quantile(off, 0.5), quantile(off, 1.0), worst.speed, worst.acceleration, worst.jerk,
        worst.tool_m_per_s, worst.tool_rad_per_s);
  }
};

class Motion : public testing::TestWithParam<Kind> {};

TEST_P(Motion, KeepsEveryJointLimitOnEveryPath) {
  const auto kind = GetParam();
  for (const test::NamedArm& arm : test::limited_arms()) {
    const Kinematics kinematics(arm.robot);
    CommandConfig command;
    command.workspace_m = 4.0 * kinematics.reach_m();
    const std::string name = arm.name + ", " + kNames[kind];
    Summary summary;
    for (int n = campaign(667, 3); n > 0; --n) {
      Random random = Random(static_cast<std::uint64_t>(1000 * kind + n)).child(arm.name);
      const Tour tour = make_tour(kind, arm.robot, kinematics, command, random);
      Drive drive(arm.robot, command, tour);
      drive.follow(random);
      drive.settle();
      const Worst& worst = drive.worst;
      ASSERT_LE(worst.position, 0.0) << name << ' ' << n;
      ASSERT_LE(worst.speed, 1.0 + 1e-9) << name << ' ' << n;
      ASSERT_LE(worst.acceleration, 1.0 + 1e-7) << name << ' ' << n;
      ASSERT_LE(worst.jerk, 1.0 + 1e-6) << name << ' ' << n;
      // It arrives, or it says that it is in its own way.
      const Outcome& outcome = drive.outcome;
      ASSERT_TRUE(outcome.arrived || outcome.blocked_s > kSettleS - 1.0) << name << ' ' << n;
      // Braking for a goal that comes towards the tool and the few ms of the jerk limit go without saying;
      // whatever is more is told.
      constexpr double kBraking = 0.8, kLateS = 0.008;  // share of the acceleration (vector_limit.hpp)
      const double v = command.speed_max_m_per_s, w = command.speed_max_rad_per_s;
      ASSERT_LE(outcome.silent_m, 2.0 * v * v / (kBraking * command.acceleration_max_m_per_s2) + kLateS * v)
          << name << ' ' << n;
      ASSERT_LE(outcome.silent_rad,
                2.0 * w * w / (kBraking * command.acceleration_max_rad_per_s2) + kLateS * w)
          << name << ' ' << n;
      summary.add(drive, kinematics.reach_m());
    }
    summary.print(name);
    // Goals on the way between two poses of one branch may still lie behind a joint limit of it.
    const double least = kind == kLimits ? 0.5 : 0.97;
    EXPECT_GE(summary.arrived, static_cast<int>(least * static_cast<double>(summary.off.size()))) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Goals, Motion, testing::Values(kSingular, kBeside, kOutOfReach, kJumps, kLimits));

}  // namespace
}  // namespace longreach
