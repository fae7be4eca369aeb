#include "common/spatial/joint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace longreach {
namespace {

constexpr double kNearlyParallel = 0.1;  // sine of the angle between two axes
constexpr double kRounding = 1e-14;      // rad, and share of the arm: not meant

double snapped(double x) { return std::abs(x) < 4e-16 ? 0.0 : x; }

// A right angle but for rounding is one.
double right_angle(double angle_rad) {
  constexpr double kRight = 0.5 * std::numbers::pi;
  const double nearest = kRight * std::round(angle_rad / kRight);
  return std::abs(angle_rad - nearest) < kRounding ? nearest : angle_rad;
}

struct Frame {
  Matrix3 R = Matrix3::Identity();
  Vector3 p_m = Vector3::Zero();
};

class Walk {
 public:
  explicit Walk(std::span<const JointAxis> axes) {
    for (const JointAxis& axis : axes) size_m_ = std::max(size_m_, axis.point_m.stableNorm());
  }

  [[nodiscard]] double length(double x_m) const { return std::abs(x_m) < kRounding * size_m_ ? 0.0 : x_m; }
  [[nodiscard]] const Frame& frame() const { return frame_; }

  /// Onto the first axis, where it is nearest to the origin of W; of a slide, where it is drawn.
  void begin(const JointAxis& first) {
    const Vector3& z = first.direction;
    frame_.p_m = first.slides ? first.point_m : Vector3(first.point_m - first.point_m.dot(z) * z);
    for (double& x : frame_.p_m) x = length(x);
    frame_.R = Quaternion::FromTwoVectors(Vector3::UnitZ(), z).normalized().toRotationMatrix();
    if (z.x() == 0.0 && z.y() == 0.0 && z.z() > 0.0) frame_.R.setIdentity();
  }

  /// From the axis that the frame is on to the next one.
  JointRow to(const JointAxis& next) {
    const Vector3 z = frame_.R.col(2), &onto = next.direction;
    const Vector3& point_m = next.point_m;
    const Vector3 normal = z.cross(onto);
    const double sine = normal.stableNorm();
    JointRow row;
    Vector3 x;
    if (sine > kNearlyParallel) {
      const Vector3 apart_m = point_m - frame_.p_m;
      x = normal / sine;
      row.a_m = length(apart_m.dot(x));
      if (row.a_m < 0.0) x = -x, row.a_m = -row.a_m;
      row.d_m = length(apart_m.cross(onto).dot(normal) / (sine * sine));
      row.alpha_rad = right_angle(std::atan2(normal.dot(x), z.dot(onto)));
    } else {
      const double along_m = (frame_.p_m - point_m).dot(z) / onto.dot(z);
      const Vector3 apart_m = point_m + along_m * onto - frame_.p_m;
      row.a_m = length(apart_m.stableNorm());
      x = row.a_m > 0.0 ? Vector3(apart_m / row.a_m) : Vector3(frame_.R.col(0));
      const Vector3 y = z.cross(x);
      row.beta_rad = right_angle(std::asin(std::clamp(onto.dot(x), -1.0, 1.0)));
      row.alpha_rad = right_angle(std::atan2(-onto.dot(y), onto.dot(z)));
    }
    row.theta_rad = right_angle(std::atan2(x.dot(frame_.R.col(1)), x.dot(frame_.R.col(0))));
    advance(row);
    return row;
  }

  /// As much of the tool's pose as is a turn about the last axis and a way along it; the remainder is `tool`.
  JointRow finish(const Pose& X_WE, Pose& tool) {
    Matrix3 R = frame_.R.transpose() * X_WE.q.toRotationMatrix();
    Vector3 p_m = frame_.R.transpose() * (X_WE.p - frame_.p_m);
    for (double& x : p_m) x = length(x);
    JointRow row;
    row.theta_rad = right_angle(std::atan2(R(1, 0), R(0, 0)));
    const bool about_z = std::hypot(R(0, 2), R(1, 2)) < kRounding && R(2, 2) > 0.0;
    if (about_z && p_m.x() == 0.0 && p_m.y() == 0.0) {
      row.d_m = p_m.z();
      return row;
    }
    tool = {p_m, Quaternion(R).normalized()};
    return {};
  }

 private:
  // By what the row says, so that what was rounded in it is made good by those that follow.
  void advance(const JointRow& row) {
    const Matrix3 turned = frame_.R * Eigen::AngleAxisd(row.theta_rad, Vector3::UnitZ()).toRotationMatrix();
    frame_.p_m += row.d_m * turned.col(2) + row.a_m * turned.col(0);
    frame_.R = turned * rotation_behind(row);
  }

  Frame frame_;
  double size_m_ = 0.0;
};

}  // namespace

Matrix3 rotation_behind(const JointRow& row) {
  const double ca = snapped(std::cos(row.alpha_rad)), sa = snapped(std::sin(row.alpha_rad));
  Matrix3 R;
  R << 1, 0, 0, 0, ca, -sa, 0, sa, ca;
  if (row.beta_rad == 0.0) return R;
  return R * Eigen::AngleAxisd(row.beta_rad, Vector3::UnitY()).toRotationMatrix();
}

JointRows joint_rows(std::span<const JointAxis> axes, const Pose& X_WE) {
  JointRows rows;
  Walk walk(axes);
  walk.begin(axes.front());
  rows.base = {walk.frame().p_m, Quaternion(walk.frame().R).normalized()};
  for (const JointAxis& next : axes.subspan(1)) rows.row.push_back(walk.to(next));
  rows.row.push_back(walk.finish(X_WE, rows.tool));
  return rows;
}

}  // namespace longreach
