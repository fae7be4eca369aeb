#include "slave/kinematics/kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "common/spatial/sin_cos.hpp"

namespace longreach {
namespace {

Rigid behind_joint(const JointRow& row) { return {rotation_behind(row), Vector3(row.a_m, 0.0, row.d_m)}; }

Rigid to_rigid(const PlacementConfig& placement) {
  return {exp_rotation(placement.rotation_rad).toRotationMatrix(), placement.position_m};
}

// Neighbours nearly parallel, and so their common normal far away?
bool far_away(const std::array<JointRow, kMaxJoints>& rows) {
  constexpr double kParallel = 0.1, kExact = 4e-16, kFar = 3.0;
  double lengths_m = 0.0;
  for (const JointRow& row : rows) lengths_m += std::abs(row.a_m);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double sine = std::abs(std::sin(rows[i].alpha_rad));
    const double along_m = std::max(std::abs(rows[i].d_m), std::abs(rows[i + 1].d_m));
    if (rows[i].beta_rad == 0.0 && sine > kExact && sine < kParallel && along_m > kFar * lengths_m)
      return true;
  }
  return false;
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
  read_rows(robot);
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointRow& row = row_[i];
    const JointConfig& j = robot.joint[i];
    reach_m_ += std::abs(row.a_m) + std::abs(row.d_m);
    if (j.kind == JointKind::kPrismatic) reach_m_ += std::max(std::abs(j.min_rad), std::abs(j.max_rad));
    any_beta_ = any_beta_ || row.beta_rad != 0.0;
    const Matrix3 twist = rotation_behind({0.0, row.alpha_rad, 0.0, 0.0, 0.0});
    link_[i] = {j.kind == JointKind::kRevolute ? 1.0 : 0.0,
                j.kind == JointKind::kPrismatic ? 1.0 : 0.0,
                row.theta_rad,
                row.d_m,
                row.a_m,
                twist(2, 2),
                twist(2, 1),
                std::cos(row.beta_rad),
                std::sin(row.beta_rad)};
  }
  link_[kMaxJoints - 1].d_m = 0.0;
  last_ = behind_joint(row_[kMaxJoints - 1]) * tool_;
  constexpr double kLeast_m = 1e-3;
  reach_m_ = std::max(reach_m_ + tool_.p.stableNorm(), kLeast_m);
  motion_length_m_ = std::max(kMotion * motion_m(robot), kLeast_m);
}

void Kinematics::read_rows(const RobotConfig& robot) {
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    row_[i] = {j.a_m, j.alpha_rad, j.beta_rad, j.d_m, j.theta_rad};
    all_revolute_ = all_revolute_ && j.kind == JointKind::kRevolute;
  }
  base_ = to_rigid(robot.base);
  tool_ = to_rigid(robot.tool);
  if (robot.convention == DhConvention::kModified) {
    base_ = base_ * behind_joint({row_[0].a_m, row_[0].alpha_rad, 0.0, 0.0, 0.0});
    for (std::size_t i = 0; i < kMaxJoints; ++i) {
      const bool last = i + 1 == kMaxJoints;
      row_[i].a_m = last ? 0.0 : row_[i + 1].a_m;
      row_[i].alpha_rad = last ? 0.0 : row_[i + 1].alpha_rad;
    }
  }
  if (all_revolute_ && far_away(row_)) renew_rows();
}

void Kinematics::renew_rows() {
  std::array<JointAxis, kMaxJoints> axes;
  Rigid X = base_;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    axes[i] = {X.p, X.R.col(2), false};
    X = X * Rigid{exp_rotation({0.0, 0.0, row_[i].theta_rad}).toRotationMatrix(), Vector3::Zero()} *
        behind_joint(row_[i]);
  }
  const JointRows rows = joint_rows(axes, to_pose(X * tool_));
  std::ranges::copy(rows.row, row_.begin());
  base_ = longreach::to_rigid(rows.base);
  tool_ = longreach::to_rigid(rows.tool);
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
      tool.pass({exp_rotation({0.0, 0.0, row_[i].theta_rad}).toRotationMatrix(), Vector3::Zero()});
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

  void tilt(const Link& link) {
    const Eigen::Vector4d ahead = link.cos_beta * x - link.sin_beta * z;
    z = link.sin_beta * x + link.cos_beta * z;
    x = ahead;
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
    if (i + 1 == kMaxJoints) break;
    X.leave(link);
    if (any_beta_) X.tilt(link);
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
