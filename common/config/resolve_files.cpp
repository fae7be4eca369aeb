// What both sides keep in files of their own: the devices of a master, robot and scene of a slave.

#include <algorithm>

#include "common/config/accuracy.hpp"
#include "common/config/config.hpp"
#include "common/config/effective.hpp"
#include "common/config/robot/robot_file.hpp"
#include "common/config/scene_files.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

const std::string kCommandLine(kFromCommandLine);

bool concerns(const Setting& setting, std::string_view part) {
  return setting.path.starts_with(part) && setting.path.size() > part.size() &&
         setting.path[part.size()] == '.';
}

// These decide what is read from a URDF.
bool chooses_links(const Setting& setting) {
  return setting.path == "robot.base_link" || setting.path == "robot.tip_link";
}

// These decide which file is read, so they are applied before it.
bool chooses_file(const Setting& setting) { return chooses_links(setting) || setting.path == "robot.mjcf"; }

/// The steps that both sides have.
template <class Side>
class Assembly {
 public:
  Assembly(const Target<Side>& target, const std::vector<Setting>& settings, const FileSearch& search,
           const AssemblyLog& log)
      : target_(target), settings_(settings), search_(search), log_(log) {}

 protected:
  Side& config() const { return target_.config(); }

  void apply(const Setting& setting) const {
    target_.apply(setting.text);
    put_origin(setting.path, kCommandLine);
  }
  void put_origin(const std::string& path, const std::string& origin) const {
    if (log_.origins != nullptr) log_.origins->replace(config(), path, origin);
  }
  void add_origin(const std::string& origin) const {
    if (log_.origins != nullptr) log_.origins->add(config(), origin);
  }
  void forget_origin(std::string_view path) const {
    if (log_.origins != nullptr) log_.origins->forget(path);
  }
  [[nodiscard]] std::string origin(const std::string& path) const {
    return log_.origins == nullptr ? "" : log_.origins->of(path);
  }

  fs::path find(const FileSearch& search, const std::string& field, const std::string& name) const {
    if (name.empty()) {
      const std::string part = field.substr(0, field.find("_file"));
      throw ConfigError(field + " is empty; name a file, or set the fields of " + part);
    }
    const fs::path path = search.find(field, name);
    if (log_.read != nullptr) log_.read->push_back({field, path});
    return path;
  }

  // Values from the preset are below all others, which are set by now.
  void finish() const {
    apply_accuracy(config());
    add_origin("preset " + proto::Accuracy_Name(config().accuracy()));
    if (!target_.of_laboratory) validate(config());
  }

  const Target<Side>& target_;
  const std::vector<Setting>& settings_;
  const FileSearch& search_;
  const AssemblyLog& log_;
};

class MasterAssembly : Assembly<proto::MasterConfig> {
 public:
  using Assembly::Assembly;

  void run() const {
    for (const Setting& setting : settings_)
      if (!concerns(setting, "device")) apply(setting);
    if (!config().device_file().empty()) {
      proto::Device device;
      const fs::path path = find(search_, "device_file", config().device_file());
      load_text_file(path, device);
      // Lists replace each other as a whole.
      const proto::Device& over = config().device();
      if (over.gravity_m_per_s2_size() > 0) device.clear_gravity_m_per_s2();
      if (over.delta().azimuth_rad_size() > 0) device.mutable_delta()->clear_azimuth_rad();
      device.MergeFrom(over);
      config().mutable_device()->Swap(&device);
      add_origin("device file " + path.string());
    }
    for (const Setting& setting : settings_)
      if (concerns(setting, "device")) apply(setting);
    finish();
    show_lists();
  }

 private:
  // Lists have no defaults of their own: what is effective is shown.
  void show_lists() const {
    const proto::Device effective = to_message(to_struct(config())).device();
    proto::Device& device = *config().mutable_device();
    if (device.gravity_m_per_s2_size() == 0)
      *device.mutable_gravity_m_per_s2() = effective.gravity_m_per_s2();
    if (device.delta().azimuth_rad_size() == 0)
      *device.mutable_delta()->mutable_azimuth_rad() = effective.delta().azimuth_rad();
  }
};

class SlaveAssembly : Assembly<proto::SlaveConfig> {
 public:
  using Assembly::Assembly;

  void run() {
    for (const Setting& setting : settings_) {
      if (concerns(setting, "scene") || (concerns(setting, "robot") && !chooses_file(setting))) continue;
      replace_contents(setting);
      apply(setting);
    }
    find_mjcf();
    const FileSearch of_scene = resolve_scene();
    resolve_robot(of_scene);
    finish();
    show_start(*config().mutable_robot());
    if (log_.warnings != nullptr)
      std::ranges::move(looser_limits(of_file_, config().robot(), robot_path_.string()),
                        std::back_inserter(*log_.warnings));
  }

 private:
  // A file that the command line names replaces a whole robot or scene of the configuration file.
  void replace_contents(const Setting& setting) const {
    if (setting.path == "scene_file" && config().has_scene()) {
      config().clear_scene();
      forget_origin("scene");
    }
    if (setting.path == "robot_file" && config().robot().joint_size() > 0) {
      config().clear_robot();
      forget_origin("robot");
    }
  }

  [[nodiscard]] bool is_mujoco() const { return !config().robot().mjcf().empty(); }

  void find_mjcf() const {
    if (!is_mujoco()) return;
    const std::string& name = config().robot().mjcf();
    if (!target_.read_mjcf)
      throw ConfigError(
          "robot.mjcf = " + name +
          ": only longreach-lab simulates the robot of an MJCF file itself; run `longreach-mujoco " + name +
          " unix:/PATH --write-robot arm.txtpb`, and set robot_adapter.address = unix:/PATH and "
          "robot_file = arm.txtpb instead");
    config().mutable_robot()->set_mjcf(fs::absolute(find(search_, "robot.mjcf", name)).string());
  }

  /// Returns the search for files that the scene names.
  FileSearch resolve_scene() const {
    FileSearch of_scene = search_;  // what the scene names is beside it
    if (is_mujoco()) {
      // ineffective_settings() reports what was set.
      for (const Setting& setting : settings_)
        if (concerns(setting, "scene")) put_origin(setting.path, kCommandLine);
      if (config().has_scene())
        throw ConfigError("scene has no effect, because robot.mjcf is set; remove one of them");
      config().mutable_scene();
      return of_scene;
    }
    // A scene in place is complete, also when it is empty: free space.
    if (!config().has_scene()) {
      const fs::path path = find(search_, "scene_file", config().scene_file());
      load_text_file(path, *config().mutable_scene());
      add_origin("scene file " + path.string());
      of_scene = search_.beside(path);
    }
    for (const Setting& setting : settings_)
      if (concerns(setting, "scene")) apply(setting);
    if (config().scene().has_bodies()) {
      load_scene_files(*config().mutable_scene()->mutable_bodies(), [&](const std::string& name) {
        return find(of_scene, "scene.bodies.mjcf_file", name);
      });
      add_origin("scene file");
    }
    return of_scene;
  }

  void resolve_robot(const FileSearch& of_scene) {
    const std::string& made_for = config().scene().robot_file();
    const bool simulated = config().robot_adapter().address().empty();
    const bool from_scene = simulated && !config().has_robot_file() && !made_for.empty();
    const bool from_mjcf = is_mujoco() && !config().has_robot_file();
    if (from_scene) {
      config().set_robot_file(made_for);
      put_origin("robot_file", "scene file");
    }
    if (config().robot().joint_size() == 0) {
      read_robot(from_scene ? of_scene : search_, from_mjcf);
    } else {
      require_joints(config().robot(), "robot");
      refuse_links();
      set_joints_from_robot(*config().mutable_robot(), true);
    }
    for (const Setting& setting : settings_) {
      if (!concerns(setting, "robot") || chooses_file(setting)) continue;
      apply(setting);
      spread(setting.path, kCommandLine);
    }
  }

  // Fields of the configuration file go over those of the robot file.
  void read_robot(const FileSearch& search, bool from_mjcf) {
    const proto::Robot over = config().robot();
    RobotFile file;
    if (from_mjcf) {
      robot_path_ = over.mjcf();
      file.robot = target_.read_mjcf(over.mjcf());
    } else {
      robot_path_ = find(search, "robot_file", config().robot_file());
      file = read_robot_file(robot_path_, over);
      if (!file.robot.mjcf().empty())
        throw ConfigError(robot_path_.string() +
                          ": mjcf is not a property of a robot file; set robot.mjcf in the configuration");
    }
    of_file_ = file.robot;
    if (log_.warnings != nullptr) std::ranges::move(file.notes, std::back_inserter(*log_.warnings));
    set_robot_fields(over, file.robot);
    config().mutable_robot()->Swap(&file.robot);
    add_origin("robot file " + robot_path_.string());
    for (const char* field : {"acceleration_max_rad_per_s2", "jerk_max_rad_per_s3", "start_rad"}) {
      const std::string path = std::string("robot.") + field;
      if (is_set(over, field)) spread(path, origin(path));
    }
  }

  static bool is_set(const proto::Robot& robot, const char* name) {
    const auto* field = robot.GetDescriptor()->FindFieldByName(name);
    return field->is_repeated() ? robot.GetReflection()->FieldSize(robot, field) > 0
                                : robot.GetReflection()->HasField(robot, field);
  }

  /// Sets in all joints what `path`, a field of the robot, sets for all of them.
  void spread(const std::string& path, const std::string& origin) const {
    const std::string field = path.substr(path.find('.') + 1);
    if (field != "acceleration_max_rad_per_s2" && field != "jerk_max_rad_per_s3" && field != "start_rad")
      return;
    proto::Robot only;  // the other fields must not replace what was set later
    const proto::Robot& robot = config().robot();
    if (field == "start_rad") *only.mutable_start_rad() = robot.start_rad();
    if (field == "acceleration_max_rad_per_s2")
      only.set_acceleration_max_rad_per_s2(robot.acceleration_max_rad_per_s2());
    if (field == "jerk_max_rad_per_s3") only.set_jerk_max_rad_per_s3(robot.jerk_max_rad_per_s3());
    only.mutable_joint()->CopyFrom(robot.joint());
    set_joints_from_robot(only, false);
    config().mutable_robot()->mutable_joint()->Swap(only.mutable_joint());
    for (int i = 0; i < config().robot().joint_size(); ++i)
      put_origin("robot.joint." + std::to_string(i) + "." + field, origin);
  }

  // Links are chosen when a URDF is read, and a whole robot in place is not read from a URDF.
  void refuse_links() const {
    for (const Setting& setting : settings_)
      if (chooses_links(setting))
        throw ConfigError(setting.text +
                          " has no effect, because the configuration file contains a whole robot; name a "
                          "URDF in robot_file");
  }

  proto::Robot of_file_;
  fs::path robot_path_;
};

// Changes a copy, so that an error leaves the original unchanged.
template <class Side>
void resolve(Side& config, const FileSearch& search, std::vector<FileRead>* read) {
  Side resolved = config;
  assemble({[&resolved]() -> Side& { return resolved; }, [](const std::string&) {}}, {}, search,
           {read, nullptr, nullptr});
  config.Swap(&resolved);
}

}  // namespace

void assemble(const Target<proto::SlaveConfig>& target, const std::vector<Setting>& settings,
              const FileSearch& search, const AssemblyLog& log) {
  SlaveAssembly(target, settings, search, log).run();
}

void assemble(const Target<proto::MasterConfig>& target, const std::vector<Setting>& settings,
              const FileSearch& search, const AssemblyLog& log) {
  MasterAssembly(target, settings, search, log).run();
}

void resolve_files(proto::MasterConfig& config, const fs::path& deploy_folder) {
  resolve_files(config, FileSearch({deploy_folder}), nullptr);
}

void resolve_files(proto::SlaveConfig& config, const fs::path& deploy_folder) {
  resolve_files(config, FileSearch({deploy_folder}), nullptr);
}

void resolve_files(proto::MasterConfig& config, const FileSearch& search, std::vector<FileRead>* read) {
  resolve(config, search, read);
}

void resolve_files(proto::SlaveConfig& config, const FileSearch& search, std::vector<FileRead>* read) {
  resolve(config, search, read);
}

}  // namespace longreach
