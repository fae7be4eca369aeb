#include "slave/command/joint_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "slave/command/vector_limit.hpp"

namespace longreach {

// With z the axes and ω_j = Σ_{i<j} q̇_i z_i:  Σ_j q̇_j [ω_j × z_j; (2 ω_j + q̇_j z_j) × J_j].
Vector6 ToolBound::turn(const JointVector& joint_rad_per_s) const {
  Vector6 V = Vector6::Zero();
  Vector3 omega = Vector3::Zero();
  for (int j = 0; j < kMaxJoints; ++j) {
    const Vector3 z = joint_rad_per_s[j] * J.col(j).head<3>(), v = joint_rad_per_s[j] * J.col(j).tail<3>();
    V.head<3>() += omega.cross(z);
    V.tail<3>() += (2.0 * omega + z).cross(v);
    omega += z;
  }
  return V;
}

JointLimiter::JointLimiter(const RobotConfig& robot) {
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    const JointConfig& j = robot.joint[i];
    joint_[i] = {j.min_rad, j.max_rad, j.speed_max_rad_per_s, j.acceleration_max_rad_per_s2,
                 j.jerk_max_rad_per_s3};
  }
}

void JointLimiter::reset(const JointVector& joint_rad) {
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    path_rad_[i] = std::clamp(joint_rad[i], j.min, j.max);
  }
  rad_per_s_.setZero();
  before_.leftCols(ticks_).colwise() = path_rad_;
  setpoint_rad_ = path_rad_;
  still_ticks_ = ticks_;
}

void JointLimiter::tune(double dt) {
  dt_ = dt;
  double ticks = 1.0;
  for (const Joint& j : joint_) ticks = std::max(ticks, std::ceil(2.0 * j.acceleration / (j.jerk * dt)));
  ticks_ = static_cast<int>(std::min(ticks, static_cast<double>(kTicksMax)));
  for (Joint& j : joint_) j.acceleration = std::min(j.acceleration, 0.5 * j.jerk * ticks_ * dt);
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

bool JointLimiter::reaches(const JointVector& wanted_rad, double dt) const {
  constexpr double kSlowShare = 0.3;  // of the speed: in no pose the tool then turns quickly
  const JointVector rad_per_s = (wanted_rad - path_rad_) / dt;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    if (!(std::abs(rad_per_s[i] - rad_per_s_[i]) <= j.acceleration * dt)) return false;
    if (!(std::abs(rad_per_s[i]) <= kSlowShare * j.speed)) return false;
  }
  return share(rad_per_s, {}).least() >= 1.0;
}

double JointLimiter::braking_s(const JointVector& rad_per_s) const {
  double s = 0.0;
  for (int i = 0; i < kMaxJoints; ++i)
    s = std::max(s, std::abs(rad_per_s[i]) / joint_[static_cast<std::size_t>(i)].acceleration);
  return s;
}

// Time in which all joints can stop together, with a reserve.
double JointLimiter::stop_s(const JointVector& rad_per_s) const {
  double s = 0.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    s = std::max(s, std::abs(rad_per_s[i]) / (kAlike * joint_[static_cast<std::size_t>(i)].acceleration));
  }
  return s + 2.0 * dt_;
}

// Returns the factors by which the speeds must be scaled so that all joints can stop together, in the time T,
// and until then
//   |q̇| <= V,  |J q̇| <= V_tool,  |J̇ q̇| T <= V_tool (the tool gains no speed),  |q̇| T/2 <= left
JointLimiter::JointsShare JointLimiter::share(const JointVector& rad_per_s, const ToolBound& tool) const {
  const Vector6 turn = tool.turn(rad_per_s);
  const double stop_s = this->stop_s(rad_per_s);
  const double used = tool.share(tool.J * rad_per_s);
  const double gained = tool.share(turn) * stop_s;
  JointsShare share;
  if (used > 1.0) share.speed = 1.0 / used;
  if (gained > 1.0) share.speed = std::min(share.speed, std::cbrt(1.0 / gained));
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    const double v = std::abs(rad_per_s[i]);
    if (v > j.speed) share.speed = std::min(share.speed, j.speed / v);
    if (!(v > j.acceleration * dt_)) continue;  // stops within a tick and does not affect the others
    const double left = rad_per_s[i] > 0.0 ? j.max - path_rad_[i] : path_rad_[i] - j.min;
    if (0.5 * v * stop_s > left)
      share.position = std::min(share.position, std::sqrt(2.0 * left / (v * stop_s)));
  }
  return share;
}

// Moves from the present speeds towards these as far as the acceleration of every joint permits.
JointVector JointLimiter::go_towards(const JointVector& rad_per_s) const {
  const JointVector change = rad_per_s - rad_per_s_;
  double most = 0.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    most = std::max(most, std::abs(change[i]) / joint_[static_cast<std::size_t>(i)].acceleration);
  }
  return most > dt_ ? JointVector(rad_per_s_ + (dt_ / most) * change) : rad_per_s;
}

// A joint that stops within a tick stops at its position limit by itself.
JointVector JointLimiter::inside(const JointVector& rad_per_s) const {
  JointVector kept = rad_per_s;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Joint& j = joint_[static_cast<std::size_t>(i)];
    kept[i] = std::clamp(kept[i], (j.min - path_rad_[i]) / dt_, (j.max - path_rad_[i]) / dt_);
  }
  return kept;
}

JointsLimited JointLimiter::limit(JointVector& rad_per_s, const ToolBound& tool) const {
  constexpr int kHalvings = 6;
  constexpr double kAll = 1.0 - 1e-9;
  const JointsShare room = share(rad_per_s, tool);
  rad_per_s *= room.least();
  const JointVector near = go_towards(rad_per_s), next = inside(near);
  const JointsLimited limited{room.speed < 1.0, room.position < 1.0 || next != near, near != rad_per_s};
  rad_per_s = next;
  if (limited.any() && share(next, tool).least() < kAll) {
    const JointVector braking = go_towards(JointVector::Zero());
    double enough = 0.0, much = 1.0;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = 0.5 * (enough + much);
      (share(inside(braking + middle * (near - braking)), tool).least() >= kAll ? enough : much) = middle;
    }
    rad_per_s = inside(braking + enough * (near - braking));
  }
  return limited;
}

// Computed as the newest point plus the mean difference from it, which is exact if all points are equal.
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
