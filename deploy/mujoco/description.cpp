#include "deploy/mujoco/description.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/mujoco/urdf_arm.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {
namespace {

constexpr std::size_t kMoving = 6;

void require_six(const MujocoWorld& world, const std::string& file) {
  if (world.joints().size() == kMoving) return;
  std::string names;
  for (const MujocoJoint& joint : world.joints()) names += (names.empty() ? "" : ", ") + joint.name;
  throw std::invalid_argument(file +
                              ": the robot must have six joints between the world and the tool, but has " +
                              std::to_string(world.joints().size()) + (names.empty() ? "" : ": " + names));
}

void set_placement(const Pose& X, proto::Placement& placement) {
  const Vector3 turn = log_rotation(X.q);
  for (int i = 0; i < 3; ++i) placement.add_position_m(X.p[i]);
  for (int i = 0; i < 3; ++i) placement.add_rotation_rad(turn[i]);
}

// A robot file has rows or links.
proto::Robot describe_urdf(const MujocoWorld& world, const std::string& file) {
  proto::Robot robot = urdf_arm(file, world.tool_link()).robot;
  robot.clear_base_link();
  robot.clear_tip_link();
  if (world.servo_hz() > 0.0) robot.set_servo_hz(world.servo_hz());
  return robot;
}

}  // namespace

proto::Robot describe(const MujocoWorld& world, const std::string& file) {
  require_six(world, file);
  if (!world.tool_link().empty()) return describe_urdf(world, file);
  std::array<JointAxis, kMoving> axes{};
  for (std::size_t i = 0; i < kMoving; ++i) axes[i] = world.joints()[i].axis;
  const JointRows rows = joint_rows(axes, world.site_at(std::array<double, kMoving>{}));
  proto::Robot robot;
  robot.set_name(world.name());
  robot.set_basis("MJCF " + file.substr(file.rfind('/') + 1));
  if (world.servo_hz() > 0.0) robot.set_servo_hz(world.servo_hz());
  set_placement(rows.base, *robot.mutable_base());
  set_placement(rows.tool, *robot.mutable_tool());
  for (std::size_t i = 0; i < kMoving; ++i) {
    const MujocoJoint& of_file = world.joints()[i];
    if (!(of_file.min < of_file.max))
      throw std::invalid_argument(file + ": the joint " + of_file.name +
                                  " has no range; add range=\"MIN MAX\" and limited=\"true\"");
    proto::Joint& joint = *robot.add_joint();
    joint.set_name(of_file.name);
    if (of_file.axis.slides) joint.set_kind(proto::Joint::PRISMATIC);
    const JointRow& row = rows.row[i];
    joint.set_theta_rad(row.theta_rad);
    joint.set_d_m(row.d_m);
    joint.set_a_m(row.a_m);
    joint.set_alpha_rad(row.alpha_rad);
    if (row.beta_rad != 0.0) joint.set_beta_rad(row.beta_rad);
    joint.set_min_rad(of_file.min);
    joint.set_max_rad(of_file.max);
    joint.set_start_rad(of_file.start);
  }
  return robot;
}

void require_same(const proto::Robot& robot, const std::string& name, const MujocoWorld& world,
                  const std::string& file) {
  require_six(world, file);
  proto::SlaveConfig config;
  *config.mutable_robot() = robot;
  const RobotConfig rows = to_struct(config).robot;
  const Kinematics kinematics(rows);
  Random random(1);
  for (int n = 0; n < 20; ++n) {
    JointVector q;
    for (int i = 0; i < q.size(); ++i) {
      const MujocoJoint& joint = world.joints()[static_cast<std::size_t>(i)];
      q[i] = random.uniform(joint.min, joint.max);
    }
    const Pose ours = kinematics.forward(q), theirs = world.site_at({q.data(), kMoving});
    const double off_m = (ours.p - theirs.p).norm(),
                 off_rad = log_rotation(ours.q.conjugate() * theirs.q).norm();
    if (off_m <= kSamePose && off_rad <= kSamePose) continue;
    char text[80];
    std::snprintf(text, sizeof text, "by %.3g m and %.3g rad", off_m, off_rad);
    throw std::invalid_argument(name + ": describes another arm than " + file +
                                ": at the same joints, the tools differ " + text +
                                "; write the file with --write-robot");
  }
}

}  // namespace longreach
