#include "slave/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slave/robot/self_motion.hpp"

namespace longreach {
namespace {

// The tool slows down from this share of a joint's speed on, and from less of it next to a singular pose,
// where the arm changes its shape so quickly that joints at full speed could not be slowed in time.
constexpr double kJointShare = 0.8;
constexpr double kJointShareLeast = 0.4;
constexpr double kQuickConditioning = 0.1;
constexpr double kSlowConditioning = 0.05;  // below it the tool slows down
constexpr double kSlowest = 0.3;            // share of speed that always remains, to get out again
constexpr double kFarRad = 0.1;             // a solution farther off than this is not one tick away
// Self motion (self_motion.hpp), measured on the paths of motion_limits_test: a narrower band sends the arm
// around singular poses at which the tool hardly leaves its way, a wider one lets it leave its way by more.
constexpr double kSingularBand = 2e-2;  // conditioning below which it is used
constexpr double kLost = 5e-3;          // at the singular pose itself
constexpr double kTurningShare = 0.5;   // of a joint's speed
constexpr double kPullMaxRad = 1.7;     // straight through a singular pose no joint turns by more than 90°
constexpr double kLeavingS = 10.0;      // so far ahead is looked when the conditioning rises

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
  conditioning_ = 1.0;
  turning_ = false;
}

Clamps SlaveMotion::step(const MotionInput& input) {
  Clamps clamps;
  const LimiterOutput wanted = limiter_.step({input.X_WE_goal, input.contact, speed_share_, input.dt});
  clamps.tool_speed = wanted.tool_speed;
  clamps.workspace = wanted.workspace;
  clamps.force_guard = wanted.force_guard;

  if (!limiter_.at_rest()) {
    const JointVector joint_before_rad = joints_.path_rad();
    const InverseResult found = invert(wanted.X_WE, input);
    clamps.unreachable = found.status == InverseStatus::kNearest;
    const bool plain = found.status == InverseStatus::kFound && joints_.reaches(found.joint_rad, input.dt);
    const JointsLimited limited = joints_.step(found.joint_rad, plain ? ToolBound{} : tool_bound(), input.dt);
    clamps.joint_speed = limited.speed;
    clamps.joint_position = limited.position || found.at_joint_limit;
    if (clamps.unreachable) ++failures_;
    clamps.singularity = found.status == InverseStatus::kSingular;
    if (limited.any()) {
      limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
    } else if (found.status != InverseStatus::kFound || found.rotation_ignored) {
      limiter_.correct(found.X_WE, input.dt);
    }
    slow_down((joints_.path_rad() - joint_before_rad) / input.dt, found.conditioning, input.dt, clamps);
  } else {
    const bool moves = !joints_.at_rest();  // the joints brake for a tool that has stopped
    joints_.step(joints_.path_rad(), moves ? tool_bound() : ToolBound{}, input.dt);
    if (moves) limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
    speed_share_ = std::max(speed_share_, 0.1);
  }
  if (!joints_.settled()) X_WE_ = kinematics().forward(joints_.setpoint_rad());
  watch_.step(joints_.setpoint_rad(), X_WE_, command_, input.dt);
  return clamps;
}

// How many ticks the joints may take for this way next to a singular pose.
double SlaveMotion::ticks_for(const JointVector& way_rad, double dt) const {
  double ticks = 0.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const double speed = robot_.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
    ticks = std::max(ticks, std::abs(way_rad[i]) / (kTurningShare * speed * dt));
  }
  return ticks;
}

// True if the tool is nowhere on this way of the joints farther from the goal than it is now.
bool SlaveMotion::leads_nearer(const JointVector& way_rad, const Rigid& X_WE_goal) const {
  const Kinematics& arm = kinematics();
  const auto off = [&](double share) {
    const Rigid X = arm.rigid_forward(joints_.path_rad() + share * way_rad);
    if (!limiter_.within(X.p)) return std::numeric_limits<double>::infinity();
    return std::hypot(arm.reach_m() * rotation_between(X.R, X_WE_goal.R).norm(), (X_WE_goal.p - X.p).norm());
  };
  const double now = off(0.0);
  for (const double share : {0.125, 0.25, 0.5, 0.75}) {
    if (off(share) > now) return false;
  }
  return true;
}

// The joints for a pose one tick away. Where the arm is at a singular pose or in its own way, the solution at
// the goal decides: the joints go there directly if the tool only comes nearer on that way and touches
// nothing, or the direction that is all but lost does, instead of the arm being led around the singular pose.
InverseResult SlaveMotion::invert(const Pose& X_WE, const MotionInput& input) {
  const double dt = input.dt;
  const Pose X_WE_goal = limiter_.goal().value_or(X_WE);
  const InverseTolerance tolerance{command_.tolerance_m, command_.iterations_max};
  const JointVector& q = joints_.path_rad();
  const Kinematics& arm = kinematics();
  InverseResult found = inverse_.follow(X_WE, q, tolerance);
  const bool far = (found.joint_rad - q).cwiseAbs().maxCoeff() > kFarRad;
  const bool lost = far || conditioning_ < kSingularBand;
  if (!lost && !turning_ && found.status != InverseStatus::kNearest) return found;
  const InverseResult there = inverse_.solve(X_WE_goal, q, tolerance);
  const JointVector way = there.joint_rad - q;
  const double most = way.cwiseAbs().maxCoeff();
  const bool exact = there.status != InverseStatus::kNearest;
  turning_ = exact && most > kFarRad && !input.contact.in_contact && leads_nearer(way, to_rigid(X_WE_goal));
  if (turning_) {
    found.joint_rad = q + way / std::max(1.0, ticks_for(way, dt));
  } else if (lost && exact && most <= kPullMaxRad) {
    SelfMotion from;
    from.joint_rad = q;
    from.pull_rad = way / std::max(1.0, ticks_for(way, dt));
    for (int i = 0; i < kMaxJoints; ++i) {
      from.min_rad[i] = robot_.joint[static_cast<std::size_t>(i)].min_rad;
      from.max_rad[i] = robot_.joint[static_cast<std::size_t>(i)].max_rad;
    }
    from.lost = far ? kLost : kLost * (1.0 - conditioning_ / kSingularBand);
    const JointVector step = self_motion_step(arm, from, to_rigid(X_WE)) - q;
    found.joint_rad = q + step / std::max(1.0, ticks_for(step, dt));
  } else {
    return found;
  }
  found.X_WE = arm.forward(found.joint_rad);
  found.status = InverseStatus::kSingular;
  return found;
}

ToolBound SlaveMotion::tool_bound() const {
  ToolBound bound;
  bound.J_share = kinematics().rigid_with_jacobian(joints_.path_rad()).J;
  bound.J_share.topRows<3>() /= command_.speed_max_rad_per_s;
  bound.J_share.bottomRows<3>() /= command_.speed_max_m_per_s;
  return bound;
}

// The share of the tool's speed limits for the next tick, so that the tool brakes before a joint has to.
void SlaveMotion::slow_down(const JointVector& rad_per_s, double conditioning, double dt, Clamps& clamps) {
  const double joint_share = std::clamp(conditioning / kQuickConditioning, kJointShareLeast, kJointShare);
  double used = 0.0;  // of the joints' speeds
  for (int i = 0; i < kMaxJoints; ++i) {
    const double speed_max = robot_.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
    used = std::max(used, std::abs(rad_per_s[i]) / (joint_share * speed_max));
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
