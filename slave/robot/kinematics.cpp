#include "slave/robot/kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "common/spatial/sin_cos.hpp"

namespace longreach {
namespace {

// Sine and cosine of a twist: right angles are meant exactly, and 1.5707963267948966 is how a file says them.
SinCos twist(double alpha_rad) {
  const SinCos t{std::sin(alpha_rad), std::cos(alpha_rad)};
  constexpr double kRounding = 4e-16;
  return {std::abs(t.s) < kRounding ? 0.0 : t.s, std::abs(t.c) < kRounding ? 0.0 : t.c};
}

Rigid behind_joint(const DhLink& row) {
  const SinCos t = twist(row.alpha_rad);
  Rigid X;
  X.R << 1, 0, 0, 0, t.c, -t.s, 0, t.s, t.c;
  X.p = {row.a_m, 0.0, row.d_m};
  return X;
}

}  // namespace

Kinematics::Kinematics(const RobotConfig& robot) {
  const bool modified = robot.convention == DhConvention::kModified;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    row_[i] = {j.a_m, j.alpha_rad, j.d_m, j.theta_rad};
    reach_m_ += std::abs(j.a_m) + std::abs(j.d_m);
    all_revolute_ = all_revolute_ && j.kind == JointKind::kRevolute;
  }
  if (modified) {
    base_ = behind_joint({row_[0].a_m, row_[0].alpha_rad, 0.0, 0.0});
    for (std::size_t i = 0; i < kMaxJoints; ++i) {
      const bool last = i + 1 == kMaxJoints;
      row_[i].a_m = last ? 0.0 : row_[i + 1].a_m;
      row_[i].alpha_rad = last ? 0.0 : row_[i + 1].alpha_rad;
    }
  }
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const SinCos t = twist(row_[i].alpha_rad);
    const JointKind kind = robot.joint[i].kind;
    link_[i] = {kind == JointKind::kRevolute ? 1.0 : 0.0,
                kind == JointKind::kPrismatic ? 1.0 : 0.0,
                row_[i].theta_rad,
                row_[i].d_m,
                row_[i].a_m,
                t.c,
                t.s};
  }
  tool_ = {exp_rotation(robot.tool.rotation_rad).toRotationMatrix(), robot.tool.position_m};
  link_[kMaxJoints - 1].d_m = 0.0;
  last_ = behind_joint(row_[kMaxJoints - 1]) * tool_;
  reach_m_ = std::max(reach_m_ + robot.tool.position_m.stableNorm(), 1e-3);
}

// The frame behind a joint's motion: column by column, because a product of 4x4 matrices does twice the work.
inline void Kinematics::enter(Rigid& X, std::size_t i, double q) const {
  const Link& link = link_[i];
  const SinCos t = sin_cos(link.turns * q + link.theta_rad);
  const Vector3 x = t.c * X.R.col(0) + t.s * X.R.col(1);
  X.R.col(1) = t.c * X.R.col(1) - t.s * X.R.col(0);
  X.R.col(0) = x;
  X.p += (link.slides * q + link.d_m) * X.R.col(2);
}

inline void Kinematics::leave(Rigid& X, const Link& link) {
  const Vector3 y = X.R.col(1);
  X.p += link.a_m * X.R.col(0);
  X.R.col(1) = link.cos_alpha * y + link.sin_alpha * X.R.col(2);
  X.R.col(2) = link.cos_alpha * X.R.col(2) - link.sin_alpha * y;
}

Rigid Kinematics::rigid_forward(const JointVector& joint_rad) const {
  Rigid X = base_;
  for (std::size_t i = 0; i + 1 < kMaxJoints; ++i) {
    enter(X, i, joint_rad[static_cast<int>(i)]);
    leave(X, link_[i]);
  }
  enter(X, kMaxJoints - 1, joint_rad[kMaxJoints - 1]);
  return X * last_;
}

RigidKinematics Kinematics::rigid_with_jacobian(const JointVector& joint_rad) const {
  RigidKinematics result;
  Eigen::Matrix<double, 3, kMaxJoints> origin;
  Rigid X = base_;
  for (int i = 0; i < kMaxJoints; ++i) {
    const auto n = static_cast<std::size_t>(i);
    result.J.col(i).head<3>() = X.R.col(2);
    origin.col(i) = X.p;
    enter(X, n, joint_rad[i]);
    if (i + 1 < kMaxJoints) leave(X, link_[n]);
  }
  result.X_WE = X * last_;
  for (int i = 0; i < kMaxJoints; ++i) {
    const Vector3 axis = result.J.col(i).head<3>();
    result.J.col(i).tail<3>() = axis.cross(result.X_WE.p - origin.col(i));
  }
  if (!all_revolute_) {
    for (int i = 0; i < kMaxJoints; ++i) {
      const Link& link = link_[static_cast<std::size_t>(i)];
      const Vector3 axis = result.J.col(i).head<3>();
      result.J.col(i).tail<3>() = link.turns * result.J.col(i).tail<3>() + link.slides * axis;
      result.J.col(i).head<3>() *= link.turns;
    }
  }
  return result;
}

ToolKinematics Kinematics::forward_with_jacobian(const JointVector& joint_rad) const {
  const RigidKinematics rigid = rigid_with_jacobian(joint_rad);
  return {to_pose(rigid.X_WE), rigid.J};
}

}  // namespace longreach
