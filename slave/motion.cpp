#include "slave/motion.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kSlack = 1.01;             // a limit counts as exceeded by more than 1 %
constexpr double kJointShare = 0.8;         // of a joint's speed, from which the tool slows down
constexpr double kSlowConditioning = 0.05;  // below it the tool slows down
constexpr double kSlowest = 0.02;           // share of speed that always remains, to get out again

const JointConfig& joint(const RobotConfig& robot, int i) { return robot.joint[static_cast<std::size_t>(i)]; }

Vector3 rotation_between(const Quaternion& from, const Quaternion& to) {
  return log_rotation(to * from.conjugate());
}

JointVector start_joints(const RobotConfig& robot) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) q[i] = joint(robot, i).start_rad;
  return q;
}

}  // namespace

SlaveMotion::SlaveMotion(const CommandConfig& command, const RobotConfig& robot)
    : command_(command),
      robot_(robot),
      inverse_(robot),
      limiter_(command, inverse_.kinematics().forward(start_joints(robot)).p) {
  reset(start_joints(robot));
}

void SlaveMotion::configure(const CommandConfig& command) {
  command_ = command;
  limiter_.configure(command);
}

void SlaveMotion::reset(const JointVector& joint_rad) {
  for (int i = 0; i < kMaxJoints; ++i) {
    joint_rad_[i] = std::clamp(joint_rad[i], joint(robot_, i).min_rad, joint(robot_, i).max_rad);
  }
  X_WE_ = inverse_.kinematics().forward(joint_rad_);
  limiter_.reset(X_WE_);
  V_WE_ = {};
  joint_rad_per_s_.setZero();
  speed_share_ = 1.0;
}

Clamps SlaveMotion::step(const MotionInput& input) {
  Clamps clamps;
  const JointVector joint_before_rad = joint_rad_;
  const Pose X_WE_before = X_WE_;
  const LimiterOutput wanted = limiter_.step({input.X_WE_goal, input.contact, speed_share_, input.dt});
  clamps.tool_speed = wanted.tool_speed;
  clamps.workspace = wanted.workspace;
  clamps.force_guard = wanted.force_guard;

  const bool still = limiter_.at_rest();
  if (!still) {
    const InverseResult found =
        inverse_.follow(wanted.X_WE, joint_rad_, {command_.tolerance_m, command_.iterations_max});
    JointVector change = found.joint_rad - joint_rad_;
    double excess = 1.0;
    for (int i = 0; i < kMaxJoints; ++i) {
      excess = std::max(excess, std::abs(change[i]) / (joint(robot_, i).speed_max_rad_per_s * input.dt));
    }
    clamps.joint_speed = excess > 1.0;
    clamps.joint_position = found.at_joint_limit;
    clamps.unreachable = found.status == InverseStatus::kNearest;
    if (clamps.unreachable) ++failures_;
    if (clamps.joint_speed) change /= excess;
    joint_rad_ += change;
    X_WE_ = clamps.joint_speed ? inverse_.kinematics().forward(joint_rad_) : found.X_WE;
    if (clamps.joint_speed || clamps.unreachable || found.rotation_ignored) limiter_.correct(X_WE_, input.dt);
    slow_down(change, found.conditioning, input.dt, clamps);
  } else {
    speed_share_ = std::max(speed_share_, 0.1);
  }
  watch(joint_before_rad, X_WE_before, input.dt);
  return clamps;
}

// The share of the tool's speed limits for the next tick, so that the tool brakes before a joint has to.
void SlaveMotion::slow_down(const JointVector& joint_change_rad, double conditioning, double dt,
                            Clamps& clamps) {
  double used = 0.0;  // of the joints' speeds
  for (int i = 0; i < kMaxJoints; ++i) {
    used = std::max(
        used, std::abs(joint_change_rad[i]) / (kJointShare * joint(robot_, i).speed_max_rad_per_s * dt));
  }
  const Twist& v = limiter_.velocity();
  const double speed = std::max(v.linear.norm() / command_.speed_max_m_per_s,
                                v.angular.norm() / command_.speed_max_rad_per_s);  // share in use
  double share = 1.0;
  if (used > 0.0 && speed > 1e-6) share = std::min(share, speed / used);
  if (share < 1.0) clamps.joint_speed = clamps.joint_speed || used > 1.0;
  if (conditioning < kSlowConditioning) {
    share = std::min(share, conditioning / kSlowConditioning);
    clamps.singularity = true;
  }
  speed_share_ = std::clamp(share, kSlowest, 1.0);
}

void SlaveMotion::watch(const JointVector& joint_before_rad, const Pose& X_WE_before, double dt) {
  const Twist V{rotation_between(X_WE_before.q, X_WE_.q) / dt, (X_WE_.p - X_WE_before.p) / dt};
  const JointVector speed = (joint_rad_ - joint_before_rad) / dt;
  bool exceeded = V.linear.norm() > kSlack * command_.speed_max_m_per_s ||
                  V.angular.norm() > kSlack * command_.speed_max_rad_per_s ||
                  (V.linear - V_WE_.linear).norm() > kSlack * command_.acceleration_max_m_per_s2 * dt ||
                  (V.angular - V_WE_.angular).norm() > kSlack * command_.acceleration_max_rad_per_s2 * dt;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = joint(robot_, i);
    exceeded = exceeded || joint_rad_[i] < j.min_rad || joint_rad_[i] > j.max_rad ||
               std::abs(speed[i]) > kSlack * j.speed_max_rad_per_s ||
               std::abs(speed[i] - joint_rad_per_s_[i]) > kSlack * j.acceleration_max_rad_per_s2 * dt;
  }
  if (exceeded) ++limit_violations_;
  V_WE_ = V;
  joint_rad_per_s_ = speed;
}

}  // namespace longreach
