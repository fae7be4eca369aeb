#include "deploy/cli/adapter/described_robot.hpp"

#include <cstring>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/text/number_text.hpp"
#include "deploy/cli/invocation.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {
namespace {

constexpr double kBeyond = 0.1;

RobotConfig robot_of(const std::string& file) try {
  proto::SlaveConfig config;
  const FileSearch search = installed_files();
  set_field(config, "robot_file",
            placed_setting("robot_file=" + file, search).substr(std::strlen("robot_file=")));
  resolve_files(config, search, nullptr);
  return to_struct(config).robot;
} catch (const ConfigError& error) {
  throw UsageError(error.what());
}

}  // namespace

struct DescribedRobot::State {
  RobotConfig robot;
  Kinematics kinematics;
};

DescribedRobot::DescribedRobot(const std::string& file) {
  const RobotConfig robot = robot_of(file);
  state_ = std::make_unique<State>(State{robot, Kinematics(robot)});
}
DescribedRobot::~DescribedRobot() = default;

Matrix3 DescribedRobot::orientation(const Vector6& joint_rad) const {
  return state_->kinematics.rigid_forward(joint_rad).R;
}

DescribedRobot::Wrong DescribedRobot::look(const Vector6& joint_rad) const {
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = state_->robot.joint[static_cast<std::size_t>(i)];
    const double q = joint_rad[i], in_degrees = q * std::numbers::pi / 180.0;
    if (j.kind == JointKind::kFixed || (q >= j.min_rad - kBeyond && q <= j.max_rad + kBeyond)) continue;
    const bool degrees = j.kind == JointKind::kRevolute && in_degrees >= j.min_rad && in_degrees <= j.max_rad;
    return {"joint " + std::to_string(i + 1) + " is at " + format_number(q) + ", beyond its limits",
            degrees ? "report radians: the values seem to be in degrees"
                    : "report rad (m for a prismatic joint), relative to the zero position defined in the "
                      "robot file"};
  }
  return {};
}

}  // namespace longreach
