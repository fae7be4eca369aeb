#include "slave/command/joint_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "slave/command/vector_limit.hpp"

namespace longreach {
namespace {

constexpr double kGently =
    0.5;  // of a joint's acceleration: all joints brake for the one that nears its limit

}  // namespace

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

JointsLimited JointLimiter::step(const JointVector& wanted_rad, double share, double dt) {
  if (dt != dt_) tune(dt);
  JointVector rad_per_s = (wanted_rad - path_rad_) / dt;
  const JointsLimited limited = limit(rad_per_s, share);
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
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double wanted = (wanted_rad[i] - path_rad_[i]) / dt;
    if (!(std::abs(wanted - rad_per_s_[i]) <= j.acceleration * dt)) return false;
    if (wanted > most(j, j.max - path_rad_[i], kGently)) return false;
    if (-wanted > most(j, path_rad_[i] - j.min, kGently)) return false;
  }
  return true;
}

JointsLimited JointLimiter::limit(JointVector& rad_per_s, double share) const {
  JointsLimited limited;
  limited.speed = share < 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double wanted = std::abs(rad_per_s[i]);
    const double left = rad_per_s[i] > 0.0 ? j.max - path_rad_[i] : path_rad_[i] - j.min;
    const double allowed = most(j, left, kGently);
    if (!(wanted > allowed)) continue;
    share = std::min(share, allowed / wanted);
    (allowed < j.speed ? limited.position : limited.speed) = true;
  }
  rad_per_s *= share;
  double part = 1.0;  // of the way from the present speeds
  for (int i = 0; i < kMaxJoints; ++i) {
    const double reach = joint_[static_cast<std::size_t>(i)].acceleration * dt_;
    const double change = std::abs(rad_per_s[i] - rad_per_s_[i]);
    if (change > reach) part = std::min(part, reach / change);
  }
  if (part < 1.0) {
    limited.speed = true;
    rad_per_s = rad_per_s_ + part * (rad_per_s - rad_per_s_);
  }
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double high = most(j, j.max - path_rad_[i], 1.0), low = -most(j, path_rad_[i] - j.min, 1.0);
    const double reach = j.acceleration * dt_, v = rad_per_s_[i];  // against rounding of the caps
    rad_per_s[i] = std::clamp(std::clamp(rad_per_s[i], low, high), v - reach, v + reach);
  }
  return limited;
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
