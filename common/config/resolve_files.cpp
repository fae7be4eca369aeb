// What both sides keep in files of their own: the devices of a master, robot and scene of a slave.

#include <algorithm>

#include "common/config/accuracy.hpp"
#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/config/scene_files.hpp"
#include "common/config/urdf.hpp"
#include "common/config/user_file.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr int kJoints = 6;

/// Looks for files, and keeps what it has read.
struct Reading {
  const FileSearch& search;
  std::vector<FileRead>* read;

  fs::path find(const std::string& field, const std::string& name) const {
    const fs::path path = search.find(field, name);
    if (read != nullptr) read->push_back({field, path});
    return path;
  }

  template <class Part>
  fs::path load(const std::string& name, const std::string& field, Part& part) const {
    if (name.empty()) throw ConfigError(field + "_file is empty; name a file, or set the fields of " + field);
    const fs::path path = find(field + "_file", name);
    load_text_file(path, part);
    return path;
  }
};

void require_joints(const proto::Robot& robot, const std::string& where) {
  if (robot.joint_size() == kJoints) return;
  throw ConfigError(where + " has " + std::to_string(robot.joint_size()) + " joints; " +
                    std::to_string(kJoints) + " are needed");
}

// Lists replace each other as a whole.
void make_room(const proto::Placement& over, proto::Placement& placement) {
  if (over.position_m_size() > 0) placement.clear_position_m();
  if (over.rotation_rad_size() > 0) placement.clear_rotation_rad();
}

proto::Robot robot_of_file(const proto::SlaveConfig& config, const Reading& reading) {
  proto::Robot robot;
  fs::path path;
  if (is_urdf(config.robot_file())) {
    path = reading.find("robot_file", config.robot_file());
    robot = read_urdf(path.string(), read_user_file(path), config.robot());
  } else {
    path = reading.load(config.robot_file(), "robot", robot);
  }
  require_joints(robot, path.string() + ": the robot");
  if (config.robot().start_rad_size() > 0) robot.clear_start_rad();
  if (config.robot().has_base()) make_room(config.robot().base(), *robot.mutable_base());
  if (config.robot().has_tool()) make_room(config.robot().tool(), *robot.mutable_tool());
  robot.MergeFrom(config.robot());
  return robot;
}

// A robot in place that has joints is complete; else its fields go over those of the file.
void resolve_robot(proto::SlaveConfig& config, const Reading& reading) {
  if (config.robot().joint_size() == 0) {
    proto::Robot robot = robot_of_file(config, reading);
    config.mutable_robot()->Swap(&robot);
  }
  proto::Robot& robot = *config.mutable_robot();
  require_joints(robot, "robot");
  if (robot.start_rad_size() != kJoints) return;  // a wrong count is said by validate()
  for (int i = 0; i < kJoints; ++i) robot.mutable_joint(i)->set_start_rad(robot.start_rad(i));
  robot.clear_start_rad();
}

}  // namespace

void resolve_files(proto::MasterConfig& config, const fs::path& deploy_folder) {
  resolve_files(config, FileSearch({deploy_folder}), nullptr);
}

void resolve_files(proto::SlaveConfig& config, const fs::path& deploy_folder) {
  resolve_files(config, FileSearch({deploy_folder}), nullptr);
}

void resolve_files(proto::MasterConfig& config, const FileSearch& search, std::vector<FileRead>* read) {
  proto::MasterConfig resolved = config;
  if (!config.device_file().empty()) {
    proto::Device device;
    (void)Reading{search, read}.load(config.device_file(), "device", device);
    // Lists replace each other as a whole.
    if (config.device().gravity_m_per_s2_size() > 0) device.clear_gravity_m_per_s2();
    if (config.device().delta().azimuth_rad_size() > 0) device.mutable_delta()->clear_azimuth_rad();
    device.MergeFrom(config.device());
    resolved.mutable_device()->Swap(&device);
  }
  apply_accuracy(resolved);
  validate(resolved);
  // Lists have no defaults of their own: what is effective is shown.
  const proto::Device effective = to_message(to_struct(resolved)).device();
  proto::Device& device = *resolved.mutable_device();
  if (device.gravity_m_per_s2_size() == 0) *device.mutable_gravity_m_per_s2() = effective.gravity_m_per_s2();
  if (device.delta().azimuth_rad_size() == 0)
    *device.mutable_delta()->mutable_azimuth_rad() = effective.delta().azimuth_rad();
  config.Swap(&resolved);
}

void resolve_files(proto::SlaveConfig& config, const FileSearch& search, std::vector<FileRead>* read) {
  proto::SlaveConfig resolved = config;
  FileSearch of_scene = search;  // what the scene names is beside it
  // A scene in place is complete, also when it is empty: free space.
  if (!resolved.has_scene()) {
    const fs::path path =
        Reading{search, read}.load(resolved.scene_file(), "scene", *resolved.mutable_scene());
    of_scene = search.beside(path);
  }
  const Reading by_scene{of_scene, read};
  if (resolved.scene().has_bodies())
    load_scene_files(*resolved.mutable_scene()->mutable_bodies(),
                     [&](const std::string& name) { return by_scene.find("scene.bodies.mjcf_file", name); });
  const std::string& made_for = resolved.scene().robot_file();
  const bool simulated = resolved.robot_adapter().address().empty();
  const bool from_scene = simulated && !resolved.has_robot_file() && !made_for.empty();
  if (from_scene) resolved.set_robot_file(made_for);
  resolve_robot(resolved, from_scene ? by_scene : Reading{search, read});
  // The sensor of the simulated robot measures moments where the scene can exert one on its own.
  if (!resolved.sensing().has_moment())
    resolved.mutable_sensing()->set_moment(
        simulated &&
        std::ranges::any_of(resolved.scene().surface(), [](const auto& s) { return s.has_hinge(); }));
  apply_accuracy(resolved);
  validate(resolved);
  config.Swap(&resolved);
}

}  // namespace longreach
