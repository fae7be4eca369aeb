#pragma once
// Reads robot files, and sets those fields of a robot that apply to all joints.

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/origins.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct RobotFile {
  proto::Robot robot;
  bool urdf = false;
  std::vector<std::string> notes;  // what the file contains and longreach ignores, one sentence for each kind
};

/// Reads a robot file in protobuf text format or URDF, which the content decides. `wanted` contains base_link and
/// tip_link, if they are set. Throws ConfigError.
RobotFile read_robot_file(const std::filesystem::path& path, const proto::Robot& wanted);

/// Throws a ConfigError that begins with `where` unless the robot has six joints.
void require_joints(const proto::Robot& robot, const std::string& where);

/// Sets acceleration_max_rad_per_s2, jerk_max_rad_per_s3 and start_rad of the joints from the fields of the robot, as
/// far as these are set; with `unset_only`, only limits that a joint does not set itself. Lists with a wrong number of
/// elements are not used; validate() reports them.
void set_joints_from_robot(proto::Robot& robot, bool unset_only);

/// Sets the fields of `over`, which has no joints, in `robot`. Lists are replaced as a whole.
void set_robot_fields(const proto::Robot& over, proto::Robot& robot);

/// If robot.start_rad is set, replaces it by the start positions of the joints, which are in force.
void show_start(proto::Robot& robot);

/// Returns one sentence for each kind of limit that is looser in `robot` than in its file.
std::vector<std::string> looser_limits(const proto::Robot& of_file, const proto::Robot& robot,
                                       const std::string& file);

}  // namespace longreach
