// Every robot that ships, and one arm in every form, feels a wall over a link.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "common/config/config.hpp"
#include "deploy/cli/robot/urdf_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "slave/kinematics/inverse.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::any_arm_test {
namespace {

namespace fs = std::filesystem;
using Values = std::map<std::string, double>;

const fs::path kDeploy = LONGREACH_DEPLOY;

Values touch(const std::string& robot_file, const std::string& profile) {
  ExperimentRun run;
  run.config = configure({"robot_file=" + robot_file, "profile=" + profile}, kDeploy);
  Values values;
  for (const Metric& m : run_touch(run)) {
    if (!m.of_machine) values[m.name] = m.value;
  }
  return values;
}

TEST(AnyArm, OfThoseThatShipFeelsAWallOverEveryLink) {
  for (const auto& entry : fs::directory_iterator(kDeploy / "robots")) {
    for (const char* profile : {"lab", "moon"}) {
      const Values v = touch("robots/" + entry.path().filename().string(), profile);
      EXPECT_LT(v.at("displayed_stiffness_error"), 0.05) << entry.path() << ' ' << profile;
      EXPECT_EQ(v.at("limit_violations"), 0.0) << entry.path() << ' ' << profile;
    }
  }
}

RobotConfig robot_of(const std::string& file) {
  proto::SlaveConfig config;
  config.set_robot_file(file);
  resolve_files(config, kDeploy);
  return to_struct(config).robot;
}

/// What a URDF does not have, as a file's text.
std::string besides(const RobotConfig& robot) {
  std::string text;
  for (const JointConfig& j : robot.joint) text += (text.empty() ? "" : ",") + std::to_string(j.start_rad);
  return text;
}

void expect_same(const Values& a, const Values& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (const auto& [name, value] : a) {
    // A coordinate that is exactly zero takes no byte.
    const double share = name == "haptic_return_bit_per_s" ? 5e-3 : 1e-6;
    EXPECT_NEAR(b.at(name), value, share * std::max(std::abs(value), 1.0)) << what << ": " << name;
  }
}

// Accelerations and jerks are no part of a URDF: those of the rows are made equal.
TEST(AnyArm, AsRowsAsUrdfAndOnAHighBaseGivesTheSameResults) {
  const TemporaryFolder folder;
  RobotConfig robot = robot_of("robots/ur5e.txtpb");
  for (JointConfig& j : robot.joint) j.acceleration_max_rad_per_s2 = 5.0, j.jerk_max_rad_per_s3 = 2500.0;
  const auto run = [&](const RobotConfig& of, const std::string& form) {
    ExperimentRun run;
    const bool urdf = form == "urdf";
    const std::string file = folder.write("arm." + form, urdf ? urdf_text(of) : "# rows\n").string();
    std::vector<std::string> settings{"profile=lab"};
    if (urdf) settings.insert(settings.end(), {"robot_file=" + file, "slave.robot.start_rad=" + besides(of)});
    run.config = configure(settings, kDeploy);
    if (!urdf) {
      SlaveConfig slave = to_struct(run.config.slave());
      slave.robot = of;
      *run.config.mutable_slave()->mutable_robot() = to_message(slave).robot();
    }
    Values values;
    for (const Metric& m : run_touch(run)) {
      if (!m.of_machine) values[m.name] = m.value;
    }
    return values;
  };
  const Values rows = run(robot, "txtpb");
  EXPECT_LT(rows.at("displayed_stiffness_error"), 0.05);
  expect_same(rows, run(robot, "urdf"), "as URDF");
  RobotConfig high = robot;
  high.joint[0].d_m += 4.0;
  expect_same(rows, run(high, "txtpb"), "on a high base");
  high = robot;
  high.base.position_m = {1.0, -2.0, 4.0};
  expect_same(rows, run(high, "txtpb"), "with a base");
}

}  // namespace
}  // namespace longreach::any_arm_test
