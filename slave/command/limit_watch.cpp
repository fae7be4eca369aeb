#include "slave/command/limit_watch.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kLimitSlack = 1.01;

}  // namespace

std::string_view name_of(Limit limit) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(Limit::kCount)> kNames = {
      "joint position", "joint speed", "joint acceleration", "joint jerk", "tool speed", "tool acceleration"};
  const auto index = static_cast<std::size_t>(limit);
  return index < kNames.size() ? kNames[index] : "none";
}

void LimitWatch::reset(const JointVector& joint_rad, const Pose& X_WE) {
  X_WE_ = X_WE;
  V_WE_ = {};
  joint_rad_ = joint_rad;
  joint_rad_per_s_.setZero();
  joint_rad_per_s2_.setZero();
}

// Called once per tick for each limit.
void LimitWatch::book(Limit limit, const JointFlags& exceeded) {
  if (!exceeded.any()) return;
  ++by_limit_.ticks[static_cast<std::size_t>(limit)];
  violated_ = true;
  if (by_limit_.first != Limit::kCount) return;
  by_limit_.first = limit;
  const bool tool = limit == Limit::kToolSpeed || limit == Limit::kToolAcceleration;
  for (int i = kMaxJoints; i > 0 && !tool; --i)
    if (exceeded[i - 1]) by_limit_.joint = i;
}

void LimitWatch::step(const JointVector& joint_rad, const Pose& X_WE, const CommandConfig& command, double dt,
                      double braking_m_per_s2) {
  const Twist V{log_rotation(X_WE.q * X_WE_.q.conjugate()) / dt, (X_WE.p - X_WE_.p) / dt};
  const JointVector speed = (joint_rad - joint_rad_) / dt;
  const JointVector acceleration = (speed - joint_rad_per_s_) / dt;
  const JointVector jerk = (acceleration - joint_rad_per_s2_) / dt;
  JointFlags position{}, fast{}, hard{}, jerky{};
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
    position[i] = joint_rad[i] < j.min_rad || joint_rad[i] > j.max_rad;
    fast[i] = std::abs(speed[i]) > kLimitSlack * j.speed_max_rad_per_s;
    hard[i] = std::abs(acceleration[i]) > kLimitSlack * j.acceleration_max_rad_per_s2;
    jerky[i] = std::abs(jerk[i]) > kLimitSlack * j.jerk_max_rad_per_s3;
  }
  const double acceleration_m_per_s2 = std::max(command.acceleration_max_m_per_s2, braking_m_per_s2);
  violated_ = false;
  book(Limit::kJointPosition, position);
  book(Limit::kJointSpeed, fast);
  book(Limit::kJointAcceleration, hard);
  book(Limit::kJointJerk, jerky);
  book(Limit::kToolSpeed, JointFlags::Constant(V.linear.norm() > kLimitSlack * command.speed_max_m_per_s ||
                                               V.angular.norm() > kLimitSlack * command.speed_max_rad_per_s));
  book(Limit::kToolAcceleration,
       JointFlags::Constant((V.linear - V_WE_.linear).norm() > kLimitSlack * acceleration_m_per_s2 * dt ||
                            (V.angular - V_WE_.angular).norm() >
                                kLimitSlack * command.acceleration_max_rad_per_s2 * dt));
  if (violated_) ++violations_;
  X_WE_ = X_WE;
  V_WE_ = V;
  joint_rad_ = joint_rad;
  joint_rad_per_s_ = speed;
  joint_rad_per_s2_ = acceleration;
}

}  // namespace longreach
