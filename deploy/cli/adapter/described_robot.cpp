#include "deploy/cli/adapter/described_robot.hpp"

#include <cstring>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/config/number_text.hpp"
#include "deploy/cli/invocation.hpp"

namespace longreach {
namespace {

constexpr double kBeyond = 0.1;

proto::Robot robot_of(const std::string& file) try {
  proto::SlaveConfig config;
  const FileSearch search = installed_files();
  set_field(config, "robot_file",
            placed_setting("robot_file=" + file, search).substr(std::strlen("robot_file=")));
  resolve_files(config, search, nullptr);
  return config.robot();
} catch (const ConfigError& error) {
  throw UsageError(error.what());
}

Matrix3 turn_x(double rad) { return exp_rotation(rad * Vector3::UnitX()).toRotationMatrix(); }
Matrix3 turn_z(double rad) { return exp_rotation(rad * Vector3::UnitZ()).toRotationMatrix(); }

}  // namespace

struct DescribedRobot::State {
  proto::Robot robot;
};

DescribedRobot::DescribedRobot(const std::string& file)
    : state_(std::make_unique<State>(State{robot_of(file)})) {}
DescribedRobot::~DescribedRobot() = default;

// The rotations of the rows, as the file's convention has them.
Matrix3 DescribedRobot::orientation(const Vector6& joint_rad) const {
  const proto::Robot& robot = state_->robot;
  Matrix3 R = Matrix3::Identity();
  for (int i = 0; i < robot.joint_size(); ++i) {
    const proto::Joint& j = robot.joint(i);
    const Matrix3 z = turn_z(j.theta_rad() + (j.kind() == proto::Joint::REVOLUTE ? joint_rad[i] : 0.0));
    const Matrix3 x = turn_x(j.alpha_rad());
    R = R * (robot.convention() == proto::Robot::STANDARD ? Matrix3(z * x) : Matrix3(x * z));
  }
  if (robot.tool().rotation_rad_size() != 3) return R;
  const auto& turn = robot.tool().rotation_rad();
  return R * exp_rotation(Vector3(turn[0], turn[1], turn[2])).toRotationMatrix();
}

DescribedRobot::Wrong DescribedRobot::look(const Vector6& joint_rad) const {
  for (int i = 0; i < state_->robot.joint_size(); ++i) {
    const proto::Joint& j = state_->robot.joint(i);
    const double q = joint_rad[i], in_degrees = q * std::numbers::pi / 180.0;
    if (j.kind() == proto::Joint::FIXED || (q >= j.min_rad() - kBeyond && q <= j.max_rad() + kBeyond))
      continue;
    const bool degrees =
        j.kind() == proto::Joint::REVOLUTE && in_degrees >= j.min_rad() && in_degrees <= j.max_rad();
    return {"joint " + std::to_string(i + 1) + " is at " + format_number(q) + ", beyond its limits",
            degrees ? "report radians: these values seem to be degrees"
                    : "report rad (m for a prismatic joint), from the zero of the robot file"};
  }
  return {};
}

}  // namespace longreach
