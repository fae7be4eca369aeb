#include "slave/motion.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kJointShare = 0.8;         // of a joint's speed, from which the tool slows down
constexpr double kSlowConditioning = 0.05;  // below it the tool slows down
constexpr double kSlowest = 0.1;            // share of speed that always remains, to get out again
constexpr double kLeavingS = 10.0;          // so far ahead is looked when the conditioning rises

JointVector start_joints(const RobotConfig& robot) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) q[i] = robot.joint[static_cast<std::size_t>(i)].start_rad;
  return q;
}

}  // namespace

SlaveMotion::SlaveMotion(const CommandConfig& command, const RobotConfig& robot)
    : command_(command),
      robot_(robot),
      inverse_(robot),
      limiter_(command, inverse_.kinematics().forward(start_joints(robot)).p),
      joints_(robot),
      watch_(robot) {
  reset(start_joints(robot));
}

void SlaveMotion::configure(const CommandConfig& command) {
  command_ = command;
  limiter_.configure(command);
}

void SlaveMotion::reset(const JointVector& joint_rad) {
  joints_.reset(joint_rad);
  X_WE_ = inverse_.kinematics().forward(joints_.setpoint_rad());
  limiter_.reset(X_WE_);
  watch_.reset(joints_.setpoint_rad(), X_WE_);
  speed_share_ = 1.0;
  conditioning_ = 0.0;
}

Clamps SlaveMotion::step(const MotionInput& input) {
  Clamps clamps;
  const LimiterOutput wanted = limiter_.step({input.X_WE_goal, input.contact, speed_share_, input.dt});
  clamps.tool_speed = wanted.tool_speed;
  clamps.workspace = wanted.workspace;
  clamps.force_guard = wanted.force_guard;

  if (!limiter_.at_rest()) {
    const JointVector joint_before_rad = joints_.path_rad();
    const InverseResult found =
        inverse_.follow(wanted.X_WE, joint_before_rad, {command_.tolerance_m, command_.iterations_max});
    clamps.unreachable = found.status == InverseStatus::kNearest;
    const bool plain = !clamps.unreachable && joints_.reaches(found.joint_rad, input.dt);
    const double share = plain ? 1.0 : tool_share((found.joint_rad - joint_before_rad) / input.dt);
    const JointsLimited limited = joints_.step(found.joint_rad, share, input.dt);
    clamps.joint_speed = limited.speed;
    clamps.joint_position = limited.position || found.at_joint_limit;
    if (clamps.unreachable) ++failures_;
    if (limited.any()) {
      limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
    } else if (clamps.unreachable || found.rotation_ignored) {
      limiter_.correct(found.X_WE, input.dt);
    }
    slow_down((joints_.path_rad() - joint_before_rad) / input.dt, found.conditioning, input.dt, clamps);
  } else {
    const bool moves = !joints_.at_rest();  // the joints brake for a tool that has stopped
    joints_.step(joints_.path_rad(), 1.0, input.dt);
    if (moves) limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
    speed_share_ = std::max(speed_share_, 0.1);
  }
  if (!joints_.settled()) X_WE_ = kinematics().forward(joints_.setpoint_rad());
  watch_.step(joints_.setpoint_rad(), X_WE_, command_, input.dt);
  return clamps;
}

// The share of these joint speeds at which the tool keeps its own limits: from branch to branch the way of
// the joints is not the one that the tool was to go.
double SlaveMotion::tool_share(const JointVector& rad_per_s) const {
  const Vector6 V = kinematics().rigid_with_jacobian(joints_.path_rad()).J * rad_per_s;
  const double used = std::max(V.tail<3>().norm() / command_.speed_max_m_per_s,
                               V.head<3>().norm() / command_.speed_max_rad_per_s);
  return used > 1.0 ? 1.0 / used : 1.0;
}

// The share of the tool's speed limits for the next tick, so that the tool brakes before a joint has to.
void SlaveMotion::slow_down(const JointVector& rad_per_s, double conditioning, double dt, Clamps& clamps) {
  double used = 0.0;  // of the joints' speeds
  for (int i = 0; i < kMaxJoints; ++i) {
    const double speed_max = robot_.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
    used = std::max(used, std::abs(rad_per_s[i]) / (kJointShare * speed_max));
  }
  const Twist& v = limiter_.velocity();
  const double speed = std::max(v.linear.norm() / command_.speed_max_m_per_s,
                                v.angular.norm() / command_.speed_max_rad_per_s);  // share in use
  double share = 1.0;
  if (used > 0.0 && speed > 1e-6) share = std::min(share, speed / used);
  if (share < 1.0) clamps.joint_speed = clamps.joint_speed || used > 1.0;
  if (conditioning < kSlowConditioning) {
    const double rise_per_s = std::max(conditioning - conditioning_, 0.0) / dt;
    share = std::min(share, (conditioning + kLeavingS * rise_per_s) / kSlowConditioning);
    clamps.singularity = true;
  }
  conditioning_ = conditioning;
  speed_share_ = std::clamp(share, kSlowest, 1.0);
}

}  // namespace longreach
