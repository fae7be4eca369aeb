#include "common/config/robot/urdf.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/robot/urdf_tree.hpp"
#include "common/config/violation.hpp"
#include "common/spatial/joint_rows.hpp"
#include "common/text/nearest_name.hpp"
#include "common/text/utf8.hpp"

namespace longreach {
namespace {

constexpr std::size_t kMoving = 6;
constexpr double kTurns_rad = 4.0 * std::numbers::pi;  // twice either way

using Joints = std::array<double, kMoving>;
using Axes = std::array<JointAxis, kMoving>;

/// The joints that move, and the tool, with all at zero.
struct ZeroPose {
  Axes axis{};
  std::vector<const UrdfJoint*> joint{};
  Pose X_WE{};
};

ZeroPose zero_pose(const UrdfTree::Arm& arm) {
  ZeroPose zero;
  for (const UrdfJoint& joint : arm.joints) {
    zero.X_WE = zero.X_WE * joint.X_PJ;
    if (joint.kind == UrdfJoint::Kind::kFixed) continue;
    zero.axis[zero.joint.size()] = {zero.X_WE.p, (zero.X_WE.q * joint.axis).normalized(),
                                    joint.kind == UrdfJoint::Kind::kPrismatic};
    zero.joint.push_back(&joint);
  }
  return zero;
}

/// How far the arm at these joints is from a singular pose, in shares of its size.
double goodness(const ZeroPose& zero, const Joints& q) {
  Pose moved;  // by all joints before
  Eigen::Matrix<double, 6, 6> J;
  Axes now = zero.axis;
  double size_m = 1e-3;
  for (std::size_t i = 0; i < kMoving; ++i) {
    const JointAxis& axis = zero.axis[i];
    now[i] = {moved.p + moved.q * axis.point_m, moved.q * axis.direction, axis.slides};
    const Pose by = axis.slides ? Pose{q[i] * axis.direction, Quaternion::Identity()}
                                : Pose{axis.point_m, exp_rotation(q[i] * axis.direction)} *
                                      Pose{-axis.point_m, Quaternion::Identity()};
    moved = moved * by;
    size_m = std::max(size_m, (axis.point_m - zero.X_WE.p).stableNorm());
  }
  const Vector3 tool_m = (moved * zero.X_WE).p;
  for (std::size_t i = 0; i < kMoving; ++i) {
    const Vector3 turns = now[i].slides ? Vector3::Zero() : now[i].direction;
    const Vector3 linear = now[i].slides ? Vector3(now[i].direction / size_m)
                                         : Vector3(now[i].direction.cross(tool_m - now[i].point_m) / size_m);
    J.col(static_cast<int>(i)) << turns, linear;
  }
  const Eigen::Matrix<double, 6, 6> square = J * J.transpose();
  return std::sqrt(std::max(square.ldlt().vectorD().minCoeff(), 0.0));
}

/// Zero if that is far enough from singular poses and limits; else the best of many places in the middle
/// half of the limits (multiples of the powers of 1/φ₆; Roberts 2018).
Joints ready_pose(const ZeroPose& zero, const Joints& min, const Joints& max) {
  constexpr double kGood = 0.05, kPhi = 1.1127756842787055;
  constexpr int kTries = 500;
  Joints best{};
  bool inside = true;
  for (std::size_t i = 0; i < kMoving; ++i) {
    const double margin = 0.05 * (max[i] - min[i]);
    inside = inside && min[i] + margin <= 0.0 && max[i] - margin >= 0.0;
  }
  if (inside && goodness(zero, best) > kGood) return best;
  double most = -1.0;
  for (int n = 1; n <= kTries; ++n) {
    Joints q;
    double share = 1.0;
    for (std::size_t i = 0; i < kMoving; ++i) {
      share /= kPhi;
      const double place = 0.5 + share * n, width = 0.5 * std::min(max[i] - min[i], 2.0 * std::numbers::pi);
      q[i] = 0.5 * (min[i] + max[i]) + width * (place - std::floor(place) - 0.5);
    }
    const double good = goodness(zero, q);
    if (good > most) most = good, best = q;
  }
  for (double& q : best) q = 1e-3 * std::round(1e3 * q);  // that a person can type
  return best;
}

void set_placement(const Pose& X, proto::Placement& placement) {
  const Vector3 turn = log_rotation(X.q);
  for (int i = 0; i < 3; ++i) placement.add_position_m(X.p[i]);
  for (int i = 0; i < 3; ++i) placement.add_rotation_rad(turn[i]);
}

void set_row(const JointRow& row, proto::Joint& joint) {
  joint.set_theta_rad(row.theta_rad);
  joint.set_d_m(row.d_m);
  joint.set_a_m(row.a_m);
  joint.set_alpha_rad(row.alpha_rad);
  if (row.beta_rad != 0.0) joint.set_beta_rad(row.beta_rad);
}

}  // namespace

bool is_urdf(const std::string& name) { return lower_case(name).ends_with(kUrdfExtension); }

bool looks_like_xml(const std::string& text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF", kSpace = " \t\r\n";
  if (is_utf16(text)) return text.find('<') < 4;
  const std::size_t first = text.find_first_not_of(kSpace, text.starts_with(kMark) ? kMark.size() : 0);
  return first != std::string::npos && text[first] == '<';
}

proto::Robot read_urdf(const std::string& name, const std::string& text, const proto::Robot& wanted,
                       std::vector<std::string>* ignored) {
  if (is_utf16(text)) throw ConfigError(name + ": the file is in UTF-16; save it in UTF-8");
  const UrdfTree tree(name, text);
  const UrdfTree::Arm arm = tree.arm(wanted.base_link(), wanted.tip_link(), static_cast<int>(kMoving));
  if (ignored != nullptr) ignored->insert(ignored->end(), arm.ignored.begin(), arm.ignored.end());
  const ZeroPose zero = zero_pose(arm);
  const JointRows rows = joint_rows(zero.axis, zero.X_WE);
  proto::Robot robot;
  robot.set_name(tree.robot_name());
  robot.set_basis("URDF " + name.substr(name.rfind('/') + 1) + ", " + arm.base_link + " to " + arm.tip_link);
  robot.set_base_link(arm.base_link);
  robot.set_tip_link(arm.tip_link);
  set_placement(rows.base, *robot.mutable_base());
  set_placement(rows.tool, *robot.mutable_tool());
  Joints min, max;
  for (std::size_t i = 0; i < kMoving; ++i) {
    const UrdfJoint& of_file = *zero.joint[i];
    const bool slides = of_file.kind == UrdfJoint::Kind::kPrismatic;
    min[i] = slides ? of_file.min : std::max(of_file.min, -kTurns_rad);
    max[i] = slides ? of_file.max : std::min(of_file.max, kTurns_rad);
    if (of_file.kind == UrdfJoint::Kind::kContinuous) min[i] = -kTurns_rad, max[i] = kTurns_rad;
    proto::Joint& joint = *robot.add_joint();
    joint.set_name(of_file.name);
    if (slides) joint.set_kind(proto::Joint::PRISMATIC);
    set_row(rows.row[i], joint);
    joint.set_min_rad(min[i]);
    joint.set_max_rad(max[i]);
    joint.set_speed_max_rad_per_s(of_file.speed_max);
    if (of_file.acceleration_max) joint.set_acceleration_max_rad_per_s2(*of_file.acceleration_max);
    if (of_file.jerk_max) joint.set_jerk_max_rad_per_s3(*of_file.jerk_max);
  }
  const Joints begin = ready_pose(zero, min, max);
  for (std::size_t i = 0; i < kMoving; ++i) robot.mutable_joint(static_cast<int>(i))->set_start_rad(begin[i]);
  if (const auto violation = find_any_violation(robot))
    throw ConfigError(name + ": the robot in this file is invalid: " + sentence(robot, *violation));
  return robot;
}

}  // namespace longreach
