#include "common/config/robot_rules.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "common/spatial/joint_rows.hpp"

namespace longreach {
namespace {

JointRow row_of(const proto::Joint& joint) {
  return {joint.a_m(), joint.alpha_rad(), joint.beta_rad(), joint.d_m(), joint.theta_rad()};
}

// The direction of each joint's axis, base to tool.
std::vector<Vector3> axes(const proto::Robot& robot) {
  const bool modified = robot.convention() == proto::Robot::MODIFIED;
  std::vector<Vector3> axes;
  Matrix3 R = Matrix3::Identity();
  for (const proto::Joint& joint : robot.joint()) {
    const Matrix3 behind = rotation_behind(row_of(joint));
    const Matrix3 turn = Eigen::AngleAxisd(joint.theta_rad(), Vector3::UnitZ()).toRotationMatrix();
    axes.emplace_back(modified ? Vector3(R * behind.col(2)) : Vector3(R.col(2)));
    R = modified ? Matrix3(R * behind * turn) : Matrix3(R * turn * behind);
  }
  return axes;
}

// What is between joint i and the next one stands in this row.
int row_between(const proto::Robot& robot, int i) {
  return robot.convention() == proto::Robot::MODIFIED ? i + 1 : i;
}

// Two neighbours that turn about one axis, or slide along one, are one joint.
Finding check_neighbours(const proto::Robot& robot) {
  constexpr double kSameAxis = 1e-6;  // m and rad
  for (int i = 0; i + 1 < robot.joint_size(); ++i) {
    const proto::Joint &one = robot.joint(i), &two = robot.joint(i + 1);
    const proto::Joint& between = robot.joint(row_between(robot, i));
    const bool slide = one.kind() == proto::Joint::PRISMATIC;
    if (one.kind() != two.kind() || one.kind() == proto::Joint::FIXED) continue;
    if (std::hypot(std::sin(between.alpha_rad()), between.beta_rad()) > kSameAxis) continue;
    if (!slide && std::abs(between.a_m()) > kSameAxis) continue;
    return at_element(robot, "joint", row_between(robot, i), "alpha_rad",
                      " = " + format_number(between.alpha_rad()) +
                          (slide ? "" : " with a_m = " + format_number(between.a_m())) + " makes joints " +
                          std::to_string(i) + " and " + std::to_string(i + 1) +
                          (slide ? " slide along" : " rotate about") +
                          " the same axis, so a degree of freedom is lost");
  }
  return std::nullopt;
}

// Calibration writes such lengths beside axes that are nearly parallel; elsewhere they are in mm.
Finding check_lengths(const proto::Robot& robot) {
  constexpr double kLong_m = 100.0, kNearlyParallel = 0.02;
  const auto parallel = [&](int row) {
    const double sine = row < 0 || row >= robot.joint_size() ? 1.0 : std::sin(robot.joint(row).alpha_rad());
    return sine != 0.0 && std::abs(sine) < kNearlyParallel;
  };
  for (int i = 0; i < robot.joint_size(); ++i) {
    const double d_m = robot.joint(i).d_m();
    if (std::abs(d_m) <= kLong_m || parallel(row_between(robot, i - 1)) || parallel(row_between(robot, i)))
      continue;
    return at_element(
        robot, "joint", i, "d_m",
        " = " + format_number(d_m) +
            " is outside the range -100 to 100, and larger magnitudes are allowed only next to nearly "
            "parallel axes; lengths are in m, but this value seems to be in mm");
  }
  return std::nullopt;
}

Finding check_beta(const proto::Robot& robot) {
  if (robot.convention() == proto::Robot::STANDARD) return std::nullopt;
  for (int i = 0; i < robot.joint_size(); ++i) {
    const double beta_rad = robot.joint(i).beta_rad();
    if (beta_rad != 0.0)
      return at_element(robot, "joint", i, "beta_rad",
                        " = " + format_number(beta_rad) + " is allowed only with convention: STANDARD");
  }
  return std::nullopt;
}

// Three slides in three directions, and the rest fixed.
Finding check_cartesian(const proto::Robot& robot, const std::vector<int>& slides) {
  const std::vector<Vector3> all = axes(robot);
  Matrix3 directions;
  for (int i = 0; i < 3; ++i)
    directions.col(i) = all[static_cast<std::size_t>(slides[static_cast<std::size_t>(i)])];
  if (std::abs(directions.determinant()) > 1e-3) return std::nullopt;
  return at_element(robot, "joint", slides[1], "alpha_rad",
                    " = " + format_number(robot.joint(slides[1]).alpha_rad()) +
                        ": the three prismatic joints can move the tool only in a plane");
}

}  // namespace

Finding check_joint(const proto::Joint& joint) {
  if (auto finding = in_order(joint, {"min_rad", joint.min_rad()}, {"max_rad", joint.max_rad()}))
    return finding;
  if (joint.start_rad() >= joint.min_rad() && joint.start_rad() <= joint.max_rad()) return std::nullopt;
  return at(joint, "start_rad",
            " = " + format_number(joint.start_rad()) + " is outside the joint's limits " +
                format_number(joint.min_rad()) + " to " + format_number(joint.max_rad()));
}

// Six joints that move, at most three of them slides; or three slides and three that are fixed.
Finding check_robot(const proto::Robot& robot) {
  std::vector<int> slides;
  int fixed = 0;
  for (int i = 0; i < robot.joint_size(); ++i) {
    if (robot.joint(i).kind() == proto::Joint::PRISMATIC) slides.push_back(i);
    if (robot.joint(i).kind() == proto::Joint::FIXED) ++fixed;
  }
  const bool cartesian = slides.size() == 3 && fixed > 0 && fixed + 3 == robot.joint_size();
  if ((fixed > 0 && !cartesian) || slides.size() > 3) {
    return at(robot, "joint",
              " has " + std::to_string(slides.size()) + " prismatic and " + std::to_string(fixed) +
                  " fixed joints; a robot needs either six revolute or prismatic joints (at most three of "
                  "them prismatic) or three prismatic and three fixed joints");
  }
  if (auto finding = check_beta(robot)) return finding;
  if (auto finding = check_lengths(robot)) return finding;
  return cartesian ? check_cartesian(robot, slides) : check_neighbours(robot);
}

}  // namespace longreach
