#include "slave/command/commanded_line.hpp"

#include <algorithm>
#include <cmath>

#include "slave/command/joint_limiter.hpp"
#include "slave/command/vector_limit.hpp"
#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kLineSmooth_s = 0.03;  // τ
constexpr double kToolBraking = 0.8;    // of the acceleration of the tool
constexpr double kJointBraking = 0.25;  // of the acceleration of the joints, for each of the two lines
constexpr double kLineMargin_m = 1e-3, kLineMargin_rad = 2e-3;
constexpr double kNoDirection = 1e-9;  // m/s or rad/s: no direction
constexpr int kLineHalvings = 12;

double stop_way(double speed, double a) {
  const double smooth = a * kLineSmooth_s;
  return speed <= smooth ? speed * kLineSmooth_s : 0.5 * (speed * speed / a + smooth * kLineSmooth_s);
}

double speed_before(double way, double a) {
  if (!(way > 0.0)) return 0.0;
  const double smooth = a * kLineSmooth_s * kLineSmooth_s;
  return way <= smooth ? way / kLineSmooth_s : std::sqrt(2.0 * a * (way - 0.5 * smooth));
}

int free_joints(const RobotConfig& robot) {
  return static_cast<int>(std::count_if(robot.joint.begin(), robot.joint.end(),
                                        [](const JointConfig& j) { return j.kind != JointKind::kFixed; }));
}

}  // namespace

/// The line of the translation or of the rotation.
struct CommandedLine::Line {
  Vector3 before, wanted;
  double acceleration, margin, dt;
  bool turns;
  double braking = 0.0;
  double joints_s = 0.0;    // in which the joints can brake what this line moves them
  double together_s = 0.0;  // the joints brake together: the line ends no sooner, with constant deceleration

  [[nodiscard]] double stop_s() const { return wanted.norm() / braking; }
  /// Returns the way to where the motion with this velocity could end, with the margin.
  [[nodiscard]] Vector3 way(const Vector3& velocity) const {
    const double speed = velocity.norm();
    if (!(speed > kNoDirection)) return Vector3::Zero();
    const double stops = std::max(stop_way(speed, braking), 0.5 * speed * together_s);
    return velocity * ((speed * dt + stops + margin) / speed);
  }
  /// Returns the speed at which the motion can end on this way.
  [[nodiscard]] double speed_on(double way) const {
    const double speed = speed_before(way, braking);
    return together_s > 0.0 ? std::min(speed, 2.0 * std::max(way, 0.0) / together_s) : speed;
  }
};

CommandedLine::CommandedLine(const Inverse& inverse, const RobotConfig& robot, const CommandConfig& command)
    : inverse_(inverse),
      command_(command),
      applies_(inverse.cartesian() || free_joints(robot) >= kMaxJoints) {
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    joint_min_rad_[i] = j.min_rad;
    joint_max_rad_[i] = j.max_rad;
    joint_speed_[i] = j.speed_max_rad_per_s;
    joint_acceleration_[i] = j.acceleration_max_rad_per_s2;
  }
}

// A singular pose or a joint limit may be that close: |Δq| <= |Δx| / (L σ) for the smallest singular value σ of J, which
// changes by about |Δq|.
bool CommandedLine::near(double way_m, double way_rad) const {
  constexpr double kSafe = 2.0;
  const double way = std::hypot(way_rad, way_m / inverse_.kinematics().motion_length_m());
  if (!(conditioning_ > 0.0)) return true;
  const double joints_rad = kSafe * std::max(way / conditioning_, way_m);  // prismatic joints move by m
  return kSafe * joints_rad > conditioning_ || inverse_.room_rad(joint_rad_) < joints_rad;
}

// Returns how fast the joints move, per m/s or rad/s along this line.
JointVector CommandedLine::joints_per_speed(const JointVector& joint_rad, const Line& line) const {
  constexpr double kDamping = 1e-9;  // of JᵀJ
  const double length_m = inverse_.kinematics().motion_length_m();
  const Jacobian J = inverse_.kinematics().rigid_with_jacobian(joint_rad).J;
  Vector6 along = Vector6::Zero();
  if (line.turns)
    along.head<3>() = length_m * line.wanted.normalized();
  else
    along.tail<3>() = line.wanted.normalized();
  return damped_step(J, length_m, along, kDamping * length_m * length_m, 0.0).joint_rad.cwiseAbs();
}

// The joints brake along with the tool; near the end of the reach, some move much faster than elsewhere.
void CommandedLine::limit_braking(Line& line) const {
  if (!(line.wanted.norm() > kNoDirection)) return;
  const double most = joints_per_speed(joint_rad_, line).cwiseQuotient(joint_acceleration_).maxCoeff();
  if (most * line.braking > kJointBraking) line.braking = kJointBraking / most;
  line.joints_s = most * line.wanted.norm() / JointLimiter::kAlike;
}

// Joints that brake together move on straight for half the time that they take (joint_limiter.hpp).
void CommandedLine::brake_joints(Line& linear, Line& angular, double dt) {
  constexpr double kDamping = 1e-9;  // of JᵀJ
  constexpr double kReserve = 1.2;
  const double length_m = inverse_.kinematics().motion_length_m();
  Vector6 V;
  V << length_m * angular.wanted, linear.wanted;
  const JointVector q = damped_step(inverse_.kinematics().rigid_with_jacobian(joint_rad_).J, length_m, V,
                                    kDamping * length_m * length_m, 0.0)
                            .joint_rad;
  double share = 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const double left = q[i] > 0.0 ? joint_max_rad_[i] - joint_rad_[i] : joint_rad_[i] - joint_min_rad_[i];
    const double way = kReserve * 0.5 * std::abs(q[i]) * linear.together_s;
    if (std::abs(q[i]) > joint_acceleration_[i] * dt && way > left)  // not of joints that stop within a tick
      share = std::min(share, std::sqrt(std::max(left, 0.0) / way));
  }
  if (!(share < 1.0)) return;
  slowed_ = true;
  for (Line* line : {&linear, &angular})
    line->wanted =
        line->before + clamp_norm(share * line->wanted - line->before, line->acceleration * line->dt);
}

// Near a singular pose, joints would have to move faster than they can. Returns the velocity at which the tool can slow
// down in time.
Vector3 CommandedLine::slow_down(const Pose& X_WE, const Line& line) {
  constexpr double kSpeed = 0.8;  // of the joints
  constexpr double kSlow_m_per_s = 5e-3,
                   kSlow_rad_per_s = 0.02;  // no slower: from there, the tool stops in a tick
  const double speed = line.wanted.norm(), slow = line.turns ? kSlow_rad_per_s : kSlow_m_per_s;
  if (!(speed > slow)) return line.wanted;
  const double way = 0.5 * speed * speed / line.braking;
  const Vector3 direction = line.wanted / speed;
  double least = speed;
  JointVector q = joint_rad_;
  for (const double share : {0.1, 0.3, 0.6, 1.0}) {
    const Vector3 part = share * way * direction;
    const Pose X = line.turns ? Pose{X_WE.p, exp_rotation(part) * X_WE.q} : Pose{X_WE.p + part, X_WE.q};
    const InverseResult there = inverse_.solve(X, q, {command_.tolerance_m, command_.iterations_max});
    if (there.status == InverseStatus::kNearest) break;  // the line ends there
    q = there.joint_rad;
    const double most = joints_per_speed(q, line).cwiseQuotient(joint_speed_).maxCoeff();
    const double allowed = most * speed > kSpeed ? kSpeed / most : speed;
    least = std::min(least, std::sqrt(allowed * allowed + 2.0 * line.braking * share * way));
  }
  if (!(least < speed)) return line.wanted;
  slowed_ = true;
  return line.before +
         clamp_norm(direction * std::max(least, slow) - line.before, line.acceleration * line.dt);
}

bool CommandedLine::reaches(const Pose& X_WE, const Vector3& way_m, const Vector3& way_rad) {
  const ReachEnd end = inverse_.reach_end({X_WE.p + way_m, exp_rotation(way_rad) * X_WE.q}, joint_rad_,
                                          {command_.tolerance_m, command_.iterations_max});
  if (end.ends) end_ = end;
  return !end.ends;
}

// Returns the velocity from which the tool can stop before the end of this line, as far as the acceleration permits.
Vector3 CommandedLine::shorten(const Pose& X_WE, const Line& line, const Vector3& other_way) {
  const Vector3 way = line.way(line.wanted);
  const double whole = way.norm();
  if (!(whole > 0.0)) return line.wanted;
  const auto free = [&](const Vector3& part, const Vector3& other) {
    return reaches(X_WE, line.turns ? other : part, line.turns ? part : other);
  };
  double enough = 0.0, much = 1.0;
  for (int i = 0; i < kLineHalvings; ++i) {
    const double middle = 0.5 * (enough + much);
    const Vector3 part = middle * way;
    // The other line may be anywhere on its way.
    const bool ok = free(part, Vector3::Zero()) && (other_way.isZero(0.0) || free(part, other_way));
    (ok ? enough : much) = middle;
  }
  const double left = enough * whole - line.margin;
  const double speed = std::min(line.speed_on(left), line.wanted.norm());
  return line.before +
         clamp_norm(line.wanted.normalized() * speed - line.before, line.acceleration * line.dt);
}

Twist CommandedLine::limit(const Pose& X_WE, const Twist& before, const Twist& wanted, double dt) {
  if (!applies_) return wanted;
  const CommandConfig& c = command_;
  Line linear{before.linear, wanted.linear, c.acceleration_max_m_per_s2, kLineMargin_m, dt, false};
  Line angular{before.angular, wanted.angular, c.acceleration_max_rad_per_s2, kLineMargin_rad, dt, true};
  // Where joints brake more slowly than the tool, the way is longer.
  constexpr double kLonger = 4.0;
  linear.braking = kToolBraking * linear.acceleration;
  angular.braking = kToolBraking * angular.acceleration;
  if (!near(kLonger * linear.way(linear.wanted).norm(), kLonger * angular.way(angular.wanted).norm()))
    return wanted;
  linear.wanted = slow_down(X_WE, linear);
  angular.wanted = slow_down(X_WE, angular);
  limit_braking(linear);
  limit_braking(angular);
  linear.together_s = angular.together_s =
      std::max({linear.stop_s(), angular.stop_s(), linear.joints_s + angular.joints_s});
  brake_joints(linear, angular, dt);
  const Vector3 way_m = linear.way(linear.wanted), way_rad = angular.way(angular.wanted);
  const Vector3 none = Vector3::Zero();
  const bool moves = way_m.isZero(0.0) || reaches(X_WE, way_m, none);
  const bool turns = way_rad.isZero(0.0) || reaches(X_WE, none, way_rad);
  const bool alone = way_m.isZero(0.0) || way_rad.isZero(0.0);
  if (moves && turns && (alone || reaches(X_WE, way_m, way_rad))) return {angular.wanted, linear.wanted};
  ended_ = true;
  if (moves != turns)
    holds_place_ = turns;  // where each could continue without the other, the one that stands stays
  if (!moves && !turns) return {shorten(X_WE, angular, none), shorten(X_WE, linear, none)};
  if (holds_place_) return {angular.wanted, shorten(X_WE, linear, way_rad)};
  return {shorten(X_WE, angular, way_m), linear.wanted};
}

}  // namespace longreach
