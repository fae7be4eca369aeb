#include "deploy/lab/robot/random_arm.hpp"

#include <cmath>

namespace longreach::test {
namespace {

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;
using LongRotation = Eigen::Matrix<Long, 3, 3>;

constexpr Long kPi = 3.14159265358979323846264338327950288L;

// The exact angle that a double stands for: multiples of right angles are exact.
Long meant(double angle_rad) {
  const Long quarter = std::round(static_cast<Long>(angle_rad) / (kPi / 2));
  return std::abs(static_cast<Long>(angle_rad) - quarter * (kPi / 2)) < 1e-15L ? quarter * (kPi / 2)
                                                                               : angle_rad;
}

LongRotation rotation(int axis, Long angle) {
  const int i = (axis + 1) % 3, k = (axis + 2) % 3;
  LongRotation R = LongRotation::Identity();
  R(i, i) = R(k, k) = std::cos(angle);
  R(k, i) = std::sin(angle);
  R(i, k) = -R(k, i);
  return R;
}

}  // namespace

double exact_error(const RobotConfig& robot, const JointVector& q, const Pose& goal, double reach_m) {
  const bool modified = robot.convention == DhConvention::kModified;
  LongRotation R = LongRotation::Identity();
  Long3 p = Long3::Zero();
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    const auto along_x = [&] {
      p += static_cast<Long>(j.a_m) * R.col(0);
      R = (R * rotation(0, meant(j.alpha_rad))).eval();
    };
    if (modified) along_x();
    R = (R * rotation(2, static_cast<Long>(q[static_cast<int>(i)]) + meant(j.theta_rad))).eval();
    p += static_cast<Long>(j.d_m) * R.col(2);
    if (!modified) along_x();
  }
  p += R * robot.tool.position_m.cast<Long>();
  const Long angle = robot.tool.rotation_rad.cast<Long>().norm();
  if (angle > 0) R = (R * Eigen::AngleAxis<Long>(angle, robot.tool.rotation_rad.cast<Long>() / angle)).eval();
  const LongRotation wanted = goal.q.cast<Long>().normalized().toRotationMatrix();
  const Long turned = (R - wanted).norm() / std::sqrt(2.0L);  // 2 sin(angle/2)
  return static_cast<double>(std::max(turned, (p - goal.p.cast<Long>()).norm() / static_cast<Long>(reach_m)));
}

double apart(const JointVector& a, const JointVector& b) {
  double most = 0.0;
  for (int i = 0; i < kMaxJoints; ++i)
    most = std::max(most, std::abs(std::remainder(a[i] - b[i], 4.0 * kHalfPi)));
  return most;
}

}  // namespace longreach::test
