// longreach robot: shows what a robot file describes, or converts it to the other form.

#include <fstream>
#include <iostream>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/robot/robot_picture.hpp"
#include "deploy/cli/robot/robot_report.hpp"
#include "deploy/cli/robot/urdf_text.hpp"

namespace longreach {
namespace {

proto::Robot described(const RobotCommand& command) {
  const FileSearch search = installed_files();
  proto::SlaveConfig config;
  config.set_robot_file(
      search.first_in(working_folder()).find_named("robot", "robots", command.file).string());
  config.mutable_scene();
  if (!command.base_link.empty()) config.mutable_robot()->set_base_link(command.base_link);
  if (!command.tip_link.empty()) config.mutable_robot()->set_tip_link(command.tip_link);
  resolve_files(config, search, nullptr);
  return config.robot();
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
  const proto::Robot robot = described(command);
  const RobotConfig config = as_struct(robot);
  if (command.what != What::kShow) {
    const std::string text = command.what == What::kUrdf ? urdf_text(config) : rows_text(robot);
    std::cout << (options.json ? "{\"text\":" + json_string(text) + "}\n" : text) << std::flush;
    return ExitStatus::kDone;
  }
  const RobotReport report = report_of(config);
  std::cout << (options.json ? report_json(report) + "\n" : report_text(report)) << std::flush;
  if (command.picture.empty()) return ExitStatus::kDone;
  std::ofstream file(command.picture);
  file << robot_picture(config) << std::flush;
  if (!file) throw UsageError("--picture " + command.picture + " cannot be written");
  return ExitStatus::kDone;
}

}  // namespace longreach
