// longreach robot: shows what a robot file describes, or converts it to the other form.

#include <algorithm>
#include <fstream>
#include <iostream>

#include "common/config/config.hpp"
#include "common/config/effective.hpp"
#include "common/config/file_search.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/robot/robot_picture.hpp"
#include "deploy/cli/robot/robot_report.hpp"
#include "deploy/cli/robot/urdf_text.hpp"

namespace longreach {
namespace {

struct Described {
  proto::Robot robot;
  Origins origins;
  std::vector<std::string> ignored;
};

Described described(const RobotCommand& command) {
  const FileSearch search = installed_files();
  proto::SlaveConfig config;
  Described out;
  config.set_robot_file(
      search.first_in(working_folder()).find_named("robot", "robots", command.file).string());
  config.mutable_scene();
  if (!command.base_link.empty()) config.mutable_robot()->set_base_link(command.base_link);
  if (!command.tip_link.empty()) config.mutable_robot()->set_tip_link(command.tip_link);
  assemble({[&config]() -> proto::SlaveConfig& { return config; }, [](const std::string&) {}}, {}, search,
           {nullptr, &out.origins, &out.ignored});
  out.robot = config.robot();
  return out;
}

/// Returns where the limits of the joints come from, one line for each kind of limit.
std::vector<std::string> limit_origins(const Described& described) {
  std::vector<std::string> lines;
  for (const auto& [name, field] :
       {std::pair{"position", "min_rad"}, std::pair{"speed", "speed_max_rad_per_s"},
        std::pair{"acceleration", "acceleration_max_rad_per_s2"}, std::pair{"jerk", "jerk_max_rad_per_s3"}}) {
    std::vector<std::string> from;
    for (int i = 0; i < described.robot.joint_size(); ++i) {
      const std::string& origin = described.origins.of("robot.joint." + std::to_string(i) + "." + field);
      if (std::ranges::find(from, origin) == from.end()) from.push_back(origin);
    }
    std::string line = std::string(name) + " from ";
    for (std::size_t i = 0; i < from.size(); ++i) line += (i == 0 ? "" : ", some joints: ") + from[i];
    lines.push_back(line);
  }
  return lines;
}

RobotConfig as_struct(const proto::Robot& robot) {
  proto::SlaveConfig config;
  *config.mutable_robot() = robot;
  return to_struct(config).robot;
}

// Text of a robot file.
std::string rows_text(proto::Robot robot) {
  robot.clear_base_link();
  robot.clear_tip_link();
  return get_field(robot, "");
}

}  // namespace

ExitStatus run_robot(const Options& options, const RobotCommand& command) {
  using What = RobotCommand::What;
  const Described read = described(command);
  const proto::Robot& robot = read.robot;
  const RobotConfig config = as_struct(robot);
  if (command.what != What::kShow) {
    const std::string text = command.what == What::kUrdf ? urdf_text(config) : rows_text(robot);
    std::cout << (options.json ? "{\"text\":" + json_string(text) + "}\n" : text) << std::flush;
    return ExitStatus::kDone;
  }
  RobotReport report = report_of(config);
  report.limits = limit_origins(read);
  report.ignored = read.ignored;
  std::cout << (options.json ? report_json(report) + "\n" : report_text(report)) << std::flush;
  if (command.picture.empty()) return ExitStatus::kDone;
  std::ofstream file(command.picture);
  file << robot_picture(config) << std::flush;
  if (!file) throw UsageError("--picture " + command.picture + " cannot be written");
  return ExitStatus::kDone;
}

}  // namespace longreach
