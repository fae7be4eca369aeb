#include "slave/kinematics/kinematics.hpp"

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

// Mean and mean square of the tool's place over all angles of the joints behind, seen from the link that they
// turn on.
struct Spread {
  Vector3 mean_m;
  Matrix3 square_m2;

  void shift(const Vector3& by_m) {
    square_m2 += mean_m * by_m.transpose() + by_m * mean_m.transpose() + by_m * by_m.transpose();
    mean_m += by_m;
  }
  void pass(const Rigid& link) {
    square_m2 = link.R * square_m2 * link.R.transpose();
    mean_m = link.R * mean_m;
    shift(link.p);
  }
  /// The mean square of the way per rad.
  double turn() {
    const double square = square_m2(0, 0) + square_m2(1, 1);
    mean_m = {0.0, 0.0, mean_m.z()};
    square_m2 = Vector3(0.5 * square, 0.5 * square, square_m2(2, 2)).asDiagonal();
    return square;
  }
  /// The square of the travel.
  double slide(double min_m, double max_m) {
    const double travel_m = max_m - min_m;
    shift({0.0, 0.0, 0.5 * (min_m + max_m)});
    square_m2(2, 2) += travel_m * travel_m / 12.0;
    return travel_m * travel_m;
  }
};

}  // namespace

JointVector start_joints(const RobotConfig& robot) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) q[i] = robot.joint[static_cast<std::size_t>(i)].start_rad;
  return q;
}

Kinematics::Kinematics(const RobotConfig& robot) {
  const bool modified = robot.convention == DhConvention::kModified;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    row_[i] = {j.a_m, j.alpha_rad, j.d_m, j.theta_rad};
    reach_m_ += std::abs(j.a_m) + std::abs(j.d_m);
    if (j.kind == JointKind::kPrismatic) reach_m_ += std::max(std::abs(j.min_rad), std::abs(j.max_rad));
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
  constexpr double kLeast_m = 1e-3;
  reach_m_ = std::max(reach_m_ + robot.tool.position_m.stableNorm(), kLeast_m);
  motion_length_m_ = std::max(kMotion * motion_m(robot), kLeast_m);
}

double Kinematics::motion_m(const RobotConfig& robot) const {
  Spread tool{tool_.p, tool_.p * tool_.p.transpose()};
  double square = 0.0;
  for (std::size_t i = kMaxJoints; i-- > 0;) {
    const JointConfig& j = robot.joint[i];
    tool.pass(behind_joint(row_[i]));
    if (j.kind == JointKind::kPrismatic) square += tool.slide(j.min_rad, j.max_rad);
    if (j.kind == JointKind::kRevolute) square += tool.turn();
    if (j.kind != JointKind::kRevolute)
      tool.pass({exp_rotation({0.0, 0.0, j.theta_rad}).toRotationMatrix(), Vector3::Zero()});
  }
  return std::sqrt(square);
}

// A frame as columns of four: two vector instructions each, where three numbers need three.
struct Kinematics::Frame {
  Eigen::Vector4d x, y, z, p;

  explicit Frame(const Rigid& X) {
    const Matrix3& R = X.R;
    x = {R(0, 0), R(1, 0), R(2, 0), 0.0};
    y = {R(0, 1), R(1, 1), R(2, 1), 0.0};
    z = {R(0, 2), R(1, 2), R(2, 2), 0.0};
    p = {X.p.x(), X.p.y(), X.p.z(), 0.0};
  }

  void turn(const SinCos& t) {
    const Eigen::Vector4d ahead = t.c * x + t.s * y;
    y = t.c * y - t.s * x;
    x = ahead;
  }

  void leave(const Link& link) {
    const Eigen::Vector4d aside = link.cos_alpha * y + link.sin_alpha * z;
    p += link.a_m * x;
    z = link.cos_alpha * z - link.sin_alpha * y;
    y = aside;
  }

  [[nodiscard]] Rigid then(const Rigid& X) const {
    const auto along = [&](double a, double b, double c) -> Eigen::Vector4d { return a * x + b * y + c * z; };
    const Eigen::Vector4d ex = along(X.R(0, 0), X.R(1, 0), X.R(2, 0)),
                          ey = along(X.R(0, 1), X.R(1, 1), X.R(2, 1)),
                          ez = along(X.R(0, 2), X.R(1, 2), X.R(2, 2)),
                          at = p + along(X.p.x(), X.p.y(), X.p.z());
    Rigid result{Matrix3(), at.head<3>()};
    result.R.col(0) = ex.head<3>(), result.R.col(1) = ey.head<3>(), result.R.col(2) = ez.head<3>();
    return result;
  }
};

// `visit(i, frame)` sees the frame in which joint i turns or slides.
template <typename Visit>
inline Rigid Kinematics::walk(const JointVector& joint_rad, const Visit& visit) const {
  std::array<double, kMaxJoints> angle;
  for (std::size_t i = 0; i < kMaxJoints; ++i)
    angle[i] = link_[i].turns * joint_rad[static_cast<int>(i)] + link_[i].theta_rad;
  const std::array<SinCos, kMaxJoints> turn = sin_cos(angle);
  Frame X(base_);
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const Link& link = link_[i];
    visit(i, X);
    X.turn(turn[i]);
    X.p += (link.slides * joint_rad[static_cast<int>(i)] + link.d_m) * X.z;
    if (i + 1 < kMaxJoints) X.leave(link);
  }
  return X.then(last_);
}

Rigid Kinematics::rigid_forward(const JointVector& joint_rad) const {
  return walk(joint_rad, [](std::size_t, const Frame&) {});
}

Rigid Kinematics::forward_into(const JointVector& joint_rad, Jacobian& J) const {
  std::array<Eigen::Vector4d, kMaxJoints> axis, origin;
  const Rigid X_WE = walk(joint_rad, [&](std::size_t i, const Frame& X) { axis[i] = X.z, origin[i] = X.p; });
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const Eigen::Vector4d &z = axis[i], &o = origin[i];
    const double x_m = X_WE.p.x() - o.x(), y_m = X_WE.p.y() - o.y(), z_m = X_WE.p.z() - o.z();
    double* column = J.col(static_cast<int>(i)).data();
    column[0] = z.x(), column[1] = z.y(), column[2] = z.z();
    column[3] = z.y() * z_m - z.z() * y_m;
    column[4] = z.z() * x_m - z.x() * z_m;
    column[5] = z.x() * y_m - z.y() * x_m;
  }
  if (!all_revolute_) {
    for (int i = 0; i < kMaxJoints; ++i) {
      const Link& link = link_[static_cast<std::size_t>(i)];
      const Vector3 direction = J.col(i).head<3>();
      J.col(i).tail<3>() = link.turns * J.col(i).tail<3>() + link.slides * direction;
      J.col(i).head<3>() *= link.turns;
    }
  }
  return X_WE;
}

RigidKinematics Kinematics::rigid_with_jacobian(const JointVector& joint_rad) const {
  RigidKinematics result;
  result.X_WE = forward_into(joint_rad, result.J);
  return result;
}

ToolKinematics Kinematics::forward_with_jacobian(const JointVector& joint_rad) const {
  ToolKinematics result;
  result.X_WE = to_pose(forward_into(joint_rad, result.J));
  return result;
}

}  // namespace longreach
