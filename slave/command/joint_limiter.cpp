#include "slave/command/joint_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "slave/command/vector_limit.hpp"
#include "slave/robot/joint_step.hpp"

namespace longreach {
namespace {

// Of a joint's acceleration, so that all can brake for the one that nears its limit.
constexpr double kGently = 0.5;
constexpr double kAlike = 0.8;

}  // namespace

JointVector ToolBound::within(const JointVector& rad_per_s) const {
  constexpr double kAim = 0.95, kDamping = 1e-4;
  Vector6 excess = J_share * rad_per_s;
  excess.head<3>() -= clamp_norm(excess.head<3>(), kAim);
  excess.tail<3>() -= clamp_norm(excess.tail<3>(), kAim);
  Matrix6 A = J_share * J_share.transpose();
  A.diagonal().array() += kDamping * A.trace();
  solve_symmetric(A, excess);
  return rad_per_s - J_share.transpose() * excess;
}

JointLimiter::JointLimiter(const RobotConfig& robot) {
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    const JointConfig& j = robot.joint[i];
    joint_[i] = {
        j.min_rad, j.max_rad, j.speed_max_rad_per_s, j.acceleration_max_rad_per_s2, j.jerk_max_rad_per_s3,
        0.0};
  }
}

void JointLimiter::reset(const JointVector& joint_rad) {
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    path_rad_[i] = std::clamp(joint_rad[i], j.min, j.max);
  }
  rad_per_s_.setZero();
  before_.colwise() = path_rad_;
  setpoint_rad_ = path_rad_;
  still_ticks_ = ticks_;
}

void JointLimiter::tune(double dt) {
  dt_ = dt;
  double ticks = 1.0;
  for (const Joint& j : joint_) ticks = std::max(ticks, std::ceil(2.0 * j.acceleration / (j.jerk * dt)));
  ticks_ = static_cast<int>(std::min(ticks, static_cast<double>(kTicksMax)));
  for (Joint& j : joint_) {
    j.acceleration = std::min(j.acceleration, 0.5 * j.jerk * ticks_ * dt);
    j.near = 0.5 * j.speed * j.speed / (kGently * j.acceleration) + 2.0 * j.speed * dt;
  }
  reset(setpoint_rad_);
}

JointsLimited JointLimiter::step(const JointVector& wanted_rad, const ToolBound& tool, double dt) {
  if (dt != dt_) tune(dt);
  JointVector rad_per_s = (wanted_rad - path_rad_) / dt;
  const JointsLimited limited = limit(rad_per_s, tool);
  rad_per_s_ = rad_per_s;
  if (limited.any()) {
    path_rad_ += rad_per_s * dt;
    for (int i = 0; i < kMaxJoints; ++i) {  // against rounding
      const Joint& j = joint_[static_cast<std::size_t>(i)];
      path_rad_[i] = std::clamp(path_rad_[i], j.min, j.max);
    }
  } else {
    path_rad_ = wanted_rad;
  }
  still_ticks_ = at_rest() ? std::min(still_ticks_ + 1, ticks_) : 0;
  average();
  return limited;
}

// Of the speed of a joint towards a position limit at `left_rad`, braking with `share` of its acceleration.
double JointLimiter::most(const Joint& j, double left_rad, double share) const {
  return left_rad < j.near ? std::min(j.speed, braking_speed(left_rad, share * j.acceleration, dt_))
                           : j.speed;
}

bool JointLimiter::reaches(const JointVector& wanted_rad, double dt) const {
  const JointVector rad_per_s = (wanted_rad - path_rad_) / dt;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    if (!(std::abs(rad_per_s[i] - rad_per_s_[i]) <= j.acceleration * dt)) return false;
    if (!(std::abs(rad_per_s[i]) <= j.speed)) return false;
  }
  return share_before_limits(rad_per_s) >= 1.0;
}

JointsLimited JointLimiter::limit(JointVector& rad_per_s, const ToolBound& tool) const {
  JointsLimited limited;
  double share = 1.0 / std::max(1.0, tool.used(rad_per_s));
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    if (std::abs(rad_per_s[i]) > j.speed) share = std::min(share, j.speed / std::abs(rad_per_s[i]));
  }
  rad_per_s *= share;
  limited.speed = share < 1.0;
  share = share_before_limits(rad_per_s);
  rad_per_s *= share;
  limited.position = share < 1.0;

  const JointVector next = go_towards(rad_per_s);
  limited.speed = limited.speed || next != rad_per_s;
  rad_per_s = next;
  if (limited.any() && !fits(rad_per_s, tool)) rad_per_s = slowed(rad_per_s, tool);
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double high = most(j, j.max - path_rad_[i], 1.0), low = -most(j, path_rad_[i] - j.min, 1.0);
    const double reach = j.acceleration * dt_, v = rad_per_s_[i];  // against rounding of the caps
    rad_per_s[i] = std::clamp(std::clamp(rad_per_s[i], low, high), v - reach, v + reach);
  }
  return limited;
}

// Of these speeds, so that every joint can stop at its position limit in the time in which all of them stop
// alike:
//   |v| T/2 <= left,  T = max |v|/A
double JointLimiter::share_before_limits(const JointVector& rad_per_s) const {
  double stop_s = 2.0 * dt_;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    stop_s = std::max(stop_s, std::abs(rad_per_s[i]) / (kAlike * j.acceleration) + 2.0 * dt_);
  }
  double share = 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double v = std::abs(rad_per_s[i]);
    if (!(v > j.acceleration * dt_)) continue;  // stops in a tick: the others need not notice
    const double left = rad_per_s[i] > 0.0 ? j.max - path_rad_[i] : path_rad_[i] - j.min;
    if (0.5 * v * stop_s > left) share = std::min(share, std::sqrt(2.0 * left / (v * stop_s)));
    const double allowed = most(j, left, kGently);
    if (v > allowed) share = std::min(share, allowed / v);
  }
  return share;
}

bool JointLimiter::fits(const JointVector& rad_per_s, const ToolBound& tool) const {
  return tool.used(rad_per_s) <= 1.0 && share_before_limits(rad_per_s) >= 1.0;
}

// As far from the present speeds towards these as every joint's acceleration allows.
JointVector JointLimiter::go_towards(const JointVector& rad_per_s) const {
  double part = 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const double reach = joint_[static_cast<std::size_t>(i)].acceleration * dt_;
    const double change = std::abs(rad_per_s[i] - rad_per_s_[i]);
    if (change > reach) part = std::min(part, reach / change);
  }
  return part < 1.0 ? JointVector(rad_per_s_ + part * (rad_per_s - rad_per_s_)) : rad_per_s;
}

// From braking towards these speeds as far as position limits and tool allow. Braking alike does not slow the
// tool while the arm changes its shape quickly: then they also go where it is slow by the least change.
JointVector JointLimiter::slowed(const JointVector& rad_per_s, const ToolBound& tool) const {
  constexpr int kHalvings = 6;
  JointVector braking = go_towards(JointVector::Zero());
  if (tool.used(braking) > 1.0) {
    const JointVector fastest = rad_per_s_.cwiseAbs();
    braking = go_towards(tool.within(braking)).cwiseMin(fastest).cwiseMax(-fastest);
  }
  double enough = 0.0, much = 1.0;
  for (int n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (enough + much);
    (fits(braking + middle * (rad_per_s - braking), tool) ? enough : much) = middle;
  }
  return braking + enough * (rad_per_s - braking);
}

// As the newest plus the mean difference from it: exact when all are equal.
void JointLimiter::average() {
  newest_ = newest_ + 1 < ticks_ ? newest_ + 1 : 0;
  before_.col(newest_) = path_rad_;
  if (settled()) {
    setpoint_rad_ = path_rad_;
    return;
  }
  JointVector difference = JointVector::Zero();
  for (int n = 0; n < ticks_; ++n) difference += before_.col(n) - path_rad_;
  setpoint_rad_ = path_rad_ + difference / ticks_;
}

}  // namespace longreach
