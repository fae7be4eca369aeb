#include "slave/robot/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

struct Frame {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();
};

// The frame after a joint: column by column, because a product of 4x4 matrices does twice the work.
template <class Link>
Frame after_joint(const Frame& f, const Link& link, double joint_rad) {
  const double angle = joint_rad + link.theta_rad;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vector3 x = c * f.R.col(0) + s * f.R.col(1);
  const Vector3 y = c * f.R.col(1) - s * f.R.col(0);
  const Vector3 z = f.R.col(2);
  Frame next;
  next.R.col(0) = x;
  next.R.col(1) = link.cos_alpha * y + link.sin_alpha * z;
  next.R.col(2) = link.cos_alpha * z - link.sin_alpha * y;
  next.p = f.p + link.d_m * z + link.a_m * x;
  return next;
}

}  // namespace

Kinematics::Kinematics(const RobotConfig& robot) {
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    link_[i] = {j.a_m, j.d_m, j.theta_rad, std::cos(j.alpha_rad), std::sin(j.alpha_rad)};
    reach_m_ += std::abs(j.a_m) + std::abs(j.d_m);
  }
  reach_m_ = std::max(reach_m_, 1e-3);
}

Pose Kinematics::forward(const JointVector& joint_rad) const {
  Frame f;
  for (std::size_t i = 0; i < kMaxJoints; ++i) f = after_joint(f, link_[i], joint_rad[static_cast<int>(i)]);
  return {f.p, Quaternion(f.R).normalized()};
}

ToolKinematics Kinematics::forward_with_jacobian(const JointVector& joint_rad) const {
  ToolKinematics result;
  Eigen::Matrix<double, 3, kMaxJoints> origin;
  Frame f;
  for (int i = 0; i < kMaxJoints; ++i) {
    result.J.col(i).head<3>() = f.R.col(2);
    origin.col(i) = f.p;
    f = after_joint(f, link_[static_cast<std::size_t>(i)], joint_rad[i]);
  }
  for (int i = 0; i < kMaxJoints; ++i) {
    const Vector3 axis = result.J.col(i).head<3>();
    result.J.col(i).tail<3>() = axis.cross(f.p - origin.col(i));
  }
  result.X_WE = {f.p, Quaternion(f.R).normalized()};
  return result;
}

}  // namespace longreach
