#include "common/config/robot/robot_file.hpp"

#include <array>

#include "common/config/config.hpp"
#include "common/config/robot/urdf.hpp"
#include "common/config/user_file.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

constexpr int kJoints = 6;

// Lists replace each other as a whole.
void make_room(const proto::Placement& over, proto::Placement& placement) {
  if (over.position_m_size() > 0) placement.clear_position_m();
  if (over.rotation_rad_size() > 0) placement.clear_rotation_rad();
}

struct Limit {
  const char* name;
  bool (proto::Joint::*has)() const;
  double (proto::Joint::*value)() const;
  bool upper;  // a greater value is looser
};

constexpr std::array kLimits{
    Limit{"min_rad", &proto::Joint::has_min_rad, &proto::Joint::min_rad, false},
    Limit{"max_rad", &proto::Joint::has_max_rad, &proto::Joint::max_rad, true},
    Limit{"speed_max_rad_per_s", &proto::Joint::has_speed_max_rad_per_s, &proto::Joint::speed_max_rad_per_s,
          true},
    Limit{"acceleration_max_rad_per_s2", &proto::Joint::has_acceleration_max_rad_per_s2,
          &proto::Joint::acceleration_max_rad_per_s2, true},
    Limit{"jerk_max_rad_per_s3", &proto::Joint::has_jerk_max_rad_per_s3, &proto::Joint::jerk_max_rad_per_s3,
          true},
};

}  // namespace

RobotFile read_robot_file(const std::filesystem::path& path, const proto::Robot& wanted) {
  RobotFile file;
  const std::string text = read_user_file(path);
  file.urdf = is_urdf(path.string()) || looks_like_xml(text);
  if (file.urdf) {
    file.robot = read_urdf(path.string(), text, wanted, &file.notes);
  } else {
    load_text(path.string(), text, file.robot);
    require_joints(file.robot, path.string() + ": the robot");
    for (const auto& [field, value] :
         {std::pair{"base_link", wanted.base_link()}, std::pair{"tip_link", wanted.tip_link()}})
      if (!value.empty())
        throw ConfigError("robot." + std::string(field) + " = \"" + value + "\" has no effect, because " +
                          path.string() +
                          " is not a URDF; remove this setting, or name a URDF in robot_file");
  }
  set_joints_from_robot(file.robot, true);
  return file;
}

void require_joints(const proto::Robot& robot, const std::string& where) {
  if (robot.joint_size() == kJoints) return;
  throw ConfigError(where + " has " + std::to_string(robot.joint_size()) + " joints; " +
                    std::to_string(kJoints) + " are needed");
}

void set_joints_from_robot(proto::Robot& robot, bool unset_only) {
  for (int i = 0; i < robot.joint_size(); ++i) {
    proto::Joint& joint = *robot.mutable_joint(i);
    if (robot.has_acceleration_max_rad_per_s2() && !(unset_only && joint.has_acceleration_max_rad_per_s2()))
      joint.set_acceleration_max_rad_per_s2(robot.acceleration_max_rad_per_s2());
    if (robot.has_jerk_max_rad_per_s3() && !(unset_only && joint.has_jerk_max_rad_per_s3()))
      joint.set_jerk_max_rad_per_s3(robot.jerk_max_rad_per_s3());
    if (robot.start_rad_size() == robot.joint_size()) joint.set_start_rad(robot.start_rad(i));
  }
}

void set_robot_fields(const proto::Robot& over, proto::Robot& robot) {
  if (over.start_rad_size() > 0) robot.clear_start_rad();
  if (over.has_base()) make_room(over.base(), *robot.mutable_base());
  if (over.has_tool()) make_room(over.tool(), *robot.mutable_tool());
  robot.MergeFrom(over);
}

void show_start(proto::Robot& robot) {
  if (robot.start_rad_size() != robot.joint_size()) return;
  for (int i = 0; i < robot.joint_size(); ++i) robot.set_start_rad(i, robot.joint(i).start_rad());
}

std::vector<std::string> looser_limits(const proto::Robot& of_file, const proto::Robot& robot,
                                       const std::string& file) {
  std::vector<std::string> sentences;
  if (of_file.joint_size() != robot.joint_size()) return sentences;
  for (const Limit& limit : kLimits) {
    int looser = 0;
    std::string sentence;
    for (int i = 0; i < robot.joint_size(); ++i) {
      if (!(of_file.joint(i).*limit.has)()) continue;
      const double before = (of_file.joint(i).*limit.value)(), now = (robot.joint(i).*limit.value)();
      if (!(limit.upper ? now > before : now < before) || ++looser > 1) continue;
      const std::string& name = robot.joint(i).name();
      sentence = "robot.joint." + (name.empty() ? std::to_string(i) : name) + "." + limit.name + " = " +
                 format_number(now) + " is looser than the limit of the robot file, " + format_number(before);
    }
    if (looser > 1) sentence += ", as for " + std::to_string(looser - 1) + " other joints";
    if (looser > 0) sentences.push_back(sentence + " (" + file + ")");
  }
  return sentences;
}

}  // namespace longreach
