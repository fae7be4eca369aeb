#include "slave/limit_watch.hpp"

#include <cmath>

namespace longreach {
namespace {

constexpr double kSlack = 1.01;

}  // namespace

void LimitWatch::reset(const JointVector& joint_rad, const Pose& X_WE) {
  X_WE_ = X_WE;
  V_WE_ = {};
  joint_rad_ = joint_rad;
  joint_rad_per_s_.setZero();
  joint_rad_per_s2_.setZero();
}

void LimitWatch::step(const JointVector& joint_rad, const Pose& X_WE, const CommandConfig& command,
                      double dt) {
  const Twist V{log_rotation(X_WE.q * X_WE_.q.conjugate()) / dt, (X_WE.p - X_WE_.p) / dt};
  bool exceeded = V.linear.norm() > kSlack * command.speed_max_m_per_s ||
                  V.angular.norm() > kSlack * command.speed_max_rad_per_s ||
                  (V.linear - V_WE_.linear).norm() > kSlack * command.acceleration_max_m_per_s2 * dt ||
                  (V.angular - V_WE_.angular).norm() > kSlack * command.acceleration_max_rad_per_s2 * dt;
  const JointVector speed = (joint_rad - joint_rad_) / dt;
  const JointVector acceleration = (speed - joint_rad_per_s_) / dt;
  const JointVector jerk = (acceleration - joint_rad_per_s2_) / dt;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
    exceeded = exceeded || joint_rad[i] < j.min_rad || joint_rad[i] > j.max_rad ||
               std::abs(speed[i]) > kSlack * j.speed_max_rad_per_s ||
               std::abs(acceleration[i]) > kSlack * j.acceleration_max_rad_per_s2 ||
               std::abs(jerk[i]) > kSlack * j.jerk_max_rad_per_s3;
  }
  if (exceeded) ++violations_;
  X_WE_ = X_WE;
  V_WE_ = V;
  joint_rad_ = joint_rad;
  joint_rad_per_s_ = speed;
  joint_rad_per_s2_ = acceleration;
}

}  // namespace longreach
