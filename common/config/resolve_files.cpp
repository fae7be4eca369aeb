// What both sides keep in files of their own: the devices of a master, robot and scene of a slave.

#include "common/config/accuracy.hpp"
#include "common/config/config.hpp"
#include "common/config/scene_files.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr int kJoints = 6;

template <class Part>
Part load_part(const fs::path& deploy_folder, const std::string& file, const char* field) {
  if (file.empty()) {
    throw ConfigError(std::string(field) + "_file is empty; name a file, or give the " + field + " in place");
  }
  Part part;
  load_text_file(deploy_folder / file, part);
  return part;
}

void require_joints(const proto::Robot& robot, const std::string& where) {
  if (robot.joint_size() == kJoints) return;
  throw ConfigError(where + " has " + std::to_string(robot.joint_size()) + " joints; " +
                    std::to_string(kJoints) + " are needed");
}

// A robot in place that has joints is complete; else its fields go over those of the file.
void resolve_robot(proto::SlaveConfig& config, const fs::path& deploy_folder) {
  if (config.robot().joint_size() == 0) {
    auto robot = load_part<proto::Robot>(deploy_folder, config.robot_file(), "robot");
    require_joints(robot, (deploy_folder / config.robot_file()).string() + ": the robot");
    robot.MergeFrom(config.robot());
    config.mutable_robot()->Swap(&robot);
  }
  require_joints(config.robot(), "robot");
}

}  // namespace

void resolve_files(proto::MasterConfig& config, const fs::path& deploy_folder) {
  proto::MasterConfig resolved = config;
  if (!config.device_file().empty()) {
    auto device = load_part<proto::Device>(deploy_folder, config.device_file(), "device");
    // Lists replace each other as a whole.
    if (config.device().gravity_m_per_s2_size() > 0) device.clear_gravity_m_per_s2();
    if (config.device().delta().azimuth_rad_size() > 0) device.mutable_delta()->clear_azimuth_rad();
    device.MergeFrom(config.device());
    resolved.mutable_device()->Swap(&device);
  }
  apply_accuracy(resolved);
  validate(resolved);
  config.Swap(&resolved);
}

void resolve_files(proto::SlaveConfig& config, const fs::path& deploy_folder) {
  proto::SlaveConfig resolved = config;
  // A scene in place is complete, also when it is empty: free space.
  if (!resolved.has_scene()) {
    *resolved.mutable_scene() = load_part<proto::Scene>(deploy_folder, resolved.scene_file(), "scene");
  }
  if (resolved.scene().has_bodies())
    load_scene_files(*resolved.mutable_scene()->mutable_bodies(), deploy_folder);
  const std::string& made_for = resolved.scene().robot_file();
  if (!resolved.has_robot_file() && !made_for.empty()) resolved.set_robot_file(made_for);
  resolve_robot(resolved, deploy_folder);
  apply_accuracy(resolved);
  validate(resolved);
  config.Swap(&resolved);
}

}  // namespace longreach
