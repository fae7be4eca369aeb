#pragma once
// A robot whose goal follows a tour (goal_tours.hpp). In every tick the differences of its setpoints, the
// distance of the tool from the goal, and the reported limits are checked from outside.

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slave/command/motion.hpp"
#include "tests/property/goal_tours.hpp"

namespace longreach::test {

constexpr double kDt = 1e-3;
constexpr double kSettleS = 120.0;  // maximum time to settle after the goal has come to rest
constexpr double kStuckS = 5.0;     // an arm that has been blocked for this time is considered stuck

struct Worst {
  double position = 0.0;                               // maximum distance beyond a limit, rad
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;  // maximum as a fraction of the limit
  double tool_m_per_s = 0.0, tool_rad_per_s = 0.0;
  /// Maximum of the smallest singular value of J (lengths relative to the reach) over all ticks in which det
  /// J changes sign.
  double singular = 0.0;
};

inline double least_singular_value(const Kinematics& arm, const JointVector& q) {
  Jacobian J = arm.rigid_with_jacobian(q).J;
  J.bottomRows<3>() /= arm.motion_length_m();
  return Eigen::JacobiSVD<Jacobian>(J).singularValues()[5];
}

// Compares the differences of the setpoints with the joint limits, and tracks the sign of det J.
class Judge {
 public:
  Judge(const RobotConfig& robot, const Kinematics& arm, const JointVector& q)
      : robot_(robot), arm_(arm), q_(q), left_(left(q)) {}

  void see(const JointVector& q, Worst& worst) {
    const JointVector v = (q - q_) / kDt, a = (v - v_) / kDt, jerk = (a - a_) / kDt;
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
      worst.position = std::max({worst.position, q[i] - j.max_rad, j.min_rad - q[i]});
      worst.speed = std::max(worst.speed, std::abs(v[i]) / j.speed_max_rad_per_s);
      worst.acceleration = std::max(worst.acceleration, std::abs(a[i]) / j.acceleration_max_rad_per_s2);
      worst.jerk = std::max(worst.jerk, std::abs(jerk[i]) / j.jerk_max_rad_per_s3);
    }
    const bool now_left = left(q);
    if (now_left != left_) worst.singular = std::max(worst.singular, least_singular_value(arm_, q));
    q_ = q, v_ = v, a_ = a, left_ = now_left;
  }

 private:
  [[nodiscard]] bool left(const JointVector& q) const {
    return arm_.rigid_with_jacobian(q).J.determinant() < 0.0;
  }

  const RobotConfig& robot_;
  const Kinematics& arm_;
  JointVector q_, v_ = JointVector::Zero(), a_ = JointVector::Zero();
  bool left_;
};

// Returns the duration of a straight motion in joint space that is limited only by the speed limits.
inline double swiftest_s(const RobotConfig& robot, const Kinematics& arm, const CommandConfig& command,
                         const JointVector& from, const JointVector& to) {
  constexpr int kParts = 100;
  double joints_s = 0.0, tool_m = 0.0, tool_rad = 0.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const double speed = robot.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
    joints_s = std::max(joints_s, std::abs(to[i] - from[i]) / speed);
  }
  Pose before = arm.forward(from);
  for (int n = 1; n <= kParts; ++n) {
    const Pose X = arm.forward(from + (to - from) * n / kParts);
    tool_m += (X.p - before.p).norm();
    tool_rad += X.q.angularDistance(before.q);
    before = X;
  }
  return std::max({joints_s, tool_m / command.speed_max_m_per_s, tool_rad / command.speed_max_rad_per_s});
}

// The time that an arm took for a path, and the minimum possible time.
struct Arrival {
  double s = 0.0, swiftest_s = 0.0;
};

struct Outcome {
  double off_m = 0.0;  // maximum distance of the tool from the path of the goal
  bool arrived = false;
  /// True if the arm reported at the end that it was blocked or that its goal was out of reach.
  bool hindered = false;
  Arrival from_rest{};  // measured from the time at which the goal came to rest
  Arrival from_free{};  // measured from the last time the arm reported that it was blocked
  /// Maximum distance of the tool from its goal while no active limit was reported.
  double silent_m = 0.0, silent_rad = 0.0;
};

inline double off_the_way(const Tour& tour, const Vector3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Leg& leg : tour.legs) {
    const Vector3 d = leg.to.p - leg.from.p;
    const double share = std::clamp(d.dot(p - leg.from.p) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
    least = std::min(least, (leg.from.p + share * d - p).norm());
  }
  return least;
}

// Drives a robot along one tour and checks it in every tick.
struct Drive {
  Drive(const RobotConfig& of, const Kinematics& arm_of, const CommandConfig& with, const Tour& on)
      : robot(of), arm(arm_of), command(with), motion(with, of), tour(on), judge(of, arm_of, on.start) {
    motion.reset(on.start);
    before = motion.X_WE();
  }

  void tick(const std::optional<Pose>& goal) {
    const Clamps c = motion.step({goal, {}, kDt});
    hindered = c.unreachable || c.joint_position;
    judge.see(motion.joint_setpoint_rad(), worst);
    const Pose& X = motion.X_WE();
    outcome.off_m = std::max(outcome.off_m, off_the_way(tour, X.p));
    const bool slow = c.tool_speed || c.joint_speed || c.acceleration;
    if (goal && !(hindered || c.singularity || slow || c.workspace)) {
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

  // Runs until the tool reaches its goal, or stops elsewhere and reports the reason.
  void settle(const Pose& goal) {
    constexpr double kThere = 1e-9, kStillRad = 1e-3;
    const JointVector from = motion.joint_setpoint_rad();
    JointVector stands = from, free = from;
    double still_s = 0.0, free_s = 0.0, t = 0.0;
    outcome.arrived = false;
    for (; t < kSettleS && still_s < kStuckS && !outcome.arrived; t += kDt) {
      tick(goal);
      const JointVector& q = motion.joint_setpoint_rad();
      still_s += kDt;
      if (!((q - stands).cwiseAbs().maxCoeff() < kStillRad)) stands = q, still_s = 0.0;
      if (!hindered) still_s = 0.0;
      if (hindered) free = q, free_s = t;
      outcome.arrived = (before.p - goal.p).norm() <= kThere &&
                        log_rotation(before.q * goal.q.conjugate()).norm() <= kThere;
    }
    outcome.hindered = hindered;
    const JointVector& to = motion.joint_setpoint_rad();
    outcome.from_rest = {t, swiftest_s(robot, arm, command, from, to)};
    outcome.from_free = {t - free_s, swiftest_s(robot, arm, command, free, to)};
  }

  const RobotConfig& robot;
  const Kinematics& arm;
  const CommandConfig& command;
  SlaveMotion motion;
  const Tour& tour;
  Judge judge;
  Pose before{};
  Worst worst{};
  Outcome outcome{};
  bool hindered = false;  // blocked in the last tick
};

}  // namespace longreach::test
