#include "deploy/mujoco/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/robot/robot_file.hpp"
#include "deploy/mujoco/description.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mujoco_world_test {
namespace {

const std::string kScenes = std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/";

/// The text that an action throws.
std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& problem) {
    return problem.what();
  }
  return "";
}

/// A finger of 0.5 kg on six slides and hinges, with `more` in the body of the finger and `rest` behind it.
std::string arm(const std::string& more, const std::string& rest, const std::string& joints = "") {
  return R"(<mujoco model="small">
  <compiler angle="radian"/>
  <default><joint limited="true" range="-1 1"/><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body><joint name="a" type="slide" axis="0 0 1"/><geom size="0.1" mass="2"/>
    <body><joint name="b" type="slide" axis="0 1 0"/><geom size="0.1" mass="2"/>
    <body><joint name="c" type="slide" axis="1 0 0"/><geom size="0.1" mass="2"/>
    <body><joint name="d" axis="0 0 1"/><geom size="0.1" mass="2"/>
    <body><joint name="e" axis="0 1 0"/><geom size="0.1" mass="2"/>
    <body><joint name="f" axis="1 0 0"/><geom size="0.1" mass="2"/>)" +
         joints + R"(
      <body name="finger"><geom size="0.02" mass="0.5"/>)" +
         more + R"(</body>
    </body></body></body></body></body></body>
  </worldbody>
  )" + rest +
         "</mujoco>\n";
}

const std::string kSite = R"(<site name="tool"/>)";
const std::string kSensors = R"(<sensor><force site="tool"/><torque site="tool"/></sensor>)";

class MujocoWorldTest : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string file = (folder_.path() / "scene.xml").string();
    std::ofstream(file) << text;
    return file;
  }
  std::string refusal(const std::string& text, const MujocoOptions& options = {}) {
    const std::string file = write(text);
    return error_of([&] { (void)describe(MujocoWorld(file, options), file); });
  }
  TemporaryFolder folder_;
};

TEST_F(MujocoWorldTest, EachSuppliedSceneIsAtRestAtItsStart) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    if (entry.path().filename() == "arm.xml") continue;
    MujocoWorld world(entry.path(), {});
    const std::vector<double> start = world.positions();
    world.step(1.0);
    for (std::size_t i = 0; i < start.size(); ++i)
      EXPECT_NEAR(world.positions()[i], start[i], 1e-9) << entry.path();
    EXPECT_LT(world.wrench().force.norm(), 1e-9) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 8);
}

TEST_F(MujocoWorldTest, ItsDescriptionHasTheToolWhereMuJoCoHasIt) {
  for (const char* name : {"wall.xml", "oblique.xml", "corner.xml", "ball.xml", "hole.xml", "valve.xml"}) {
    const std::string file = kScenes + name;
    const MujocoWorld world(file, {});
    const proto::Robot robot = describe(world, file);
    EXPECT_NO_THROW(require_same(robot, "it", world, file));
    EXPECT_EQ(robot.joint(0).name(), "base_yaw");
    EXPECT_EQ(robot.joint(1).start_rad(), -0.4);
    proto::Robot moved = robot;
    moved.mutable_joint(2)->set_a_m(moved.joint(2).a_m() + 1e-6);
    EXPECT_NE(error_of([&] {
                require_same(moved, "other.txtpb", world, file);
              }).find("other.txtpb: describes another arm"),
              std::string::npos);
  }
}

// A control: another arm.
TEST_F(MujocoWorldTest, AnotherRobotFileIsRefused) {
  const std::string file = kScenes + "wall.xml";
  const MujocoWorld world(file, {});
  const std::string other = std::string(LONGREACH_DEPLOY) + "/robots/puma560.txtpb";
  EXPECT_NE(error_of([&] {
              require_same(read_robot_file(other, {}).robot, other, world, file);
            }).find("describes another arm"),
            std::string::npos);
}

TEST_F(MujocoWorldTest, TheWrenchIsThatOfTheEnvironmentOnTheTool) {
  // The site looks down: its z is -z of the world.
  const std::string file =
      write(arm(R"(<site name="tool" pos="0 0 0" euler="3.141592653589793 0 0"/>)", kSensors));
  MujocoWorld world(file, {.servo_hz = 20.0});
  world.step(0.5);
  const Wrench weight = world.wrench();
  EXPECT_NEAR(weight.force.z(), 0.5 * 9.81, 0.01) << "the weight of the finger pulls along z of the site";
  EXPECT_NEAR(weight.force.head<2>().norm(), 0.0, 0.01);
}

TEST_F(MujocoWorldTest, JointsFollowByComputedTorqueAndKeepTheirPlaceAfterAStop) {
  MujocoWorld world(kScenes + "wall.xml", {});
  EXPECT_EQ(world.servo_hz(), 10.0) << "the file has no actuators";
  std::vector<double> q = world.positions();
  for (double& joint : q) joint += 0.05;
  world.follow(q);
  world.step(0.5);
  const std::vector<double> reached = world.positions();
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(reached[i], q[i], 1e-4) << i;
  world.stop();
  world.step(1.0);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(world.positions()[i], reached[i], 1e-4) << i;
}

TEST_F(MujocoWorldTest, JointsFollowByThePositionActuatorsOfTheFile) {
  std::string actuators = "<actuator>";
  for (const char* joint : {"a", "b", "c", "d", "e", "f"})
    actuators += std::string("<position joint=\"") + joint + "\" kp=\"4000\"/>";
  const std::string damped = R"(<option gravity="0 0 0"/>)" + kSensors + actuators + "</actuator>";
  std::string text = arm(kSite, damped);
  text.insert(text.find("limited="), "damping=\"200\" ");
  MujocoWorld world(write(text), {});
  EXPECT_EQ(world.servo_hz(), 0.0);
  world.follow(std::array{0.1, 0.0, -0.1, 0.0, 0.05, 0.0});
  world.step(3.0);
  EXPECT_NEAR(world.positions()[0], 0.1, 1e-3);
  EXPECT_NEAR(world.positions()[2], -0.1, 1e-3);
}

TEST_F(MujocoWorldTest, AWallPushesWithItsSpring) {
  const std::string wall = R"(<worldbody><body pos="0.1 0 0">
    <joint type="slide" axis="1 0 0" stiffness="5000" damping="8" limited="false"/>
    <geom type="box" size="0.01 0.3 0.3" mass="0.1" contype="1" conaffinity="1" solref="-2e6 -3000"/></body></worldbody>)";
  const std::string tip =
      R"(<geom size="0.02" mass="0.01" contype="1" conaffinity="1" solref="-2e6 -3000"/>)";
  MujocoWorld world(
      write(arm(kSite + tip, R"(<option gravity="0 0 0" timestep="0.0005"/>)" + wall + kSensors)),
      {.servo_hz = 20.0});
  world.follow(std::array{0.0, 0.0, 0.073, 0.0, 0.0, 0.0});  // 3 mm behind the wall, if it did not push
  world.step(2.0);
  world.step(0.001);  // the reading is the mean over this
  const double depth_m = world.positions()[2] - 0.07;
  EXPECT_GT(depth_m, 1e-3);
  EXPECT_NEAR(-world.wrench().force.x(), 5000.0 * depth_m, 0.01 * 5000.0 * depth_m);
}

TEST_F(MujocoWorldTest, TheNoiseHasItsStandardDeviationAndSeed) {
  const std::string file = kScenes + "wall.xml";
  MujocoWorld one(file, {.force_noise_n = 0.2}), same(file, {.force_noise_n = 0.2}),
      other(file, {.force_noise_n = 0.2, .seed = 2});
  double sum = 0.0;
  constexpr int kSamples = 4000;
  bool differs = false;
  for (int i = 0; i < kSamples; ++i) {
    const Wrench now = one.measured();
    EXPECT_EQ(now.force, same.measured().force);
    differs = differs || now.force != other.measured().force;
    sum += (now.force - one.wrench().force).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum / (3.0 * kSamples)), 0.2, 0.01);
  EXPECT_TRUE(differs);
}

TEST_F(MujocoWorldTest, TheBiasIsAddedToTheReadings) {
  MujocoWorld world(kScenes + "wall.xml",
                    {.force_noise_n = 0.0,
                     .moment_noise_nm = 0.0,
                     .bias = {.moment = Vector3(0.1, 0.0, -0.2), .force = Vector3(1.0, -2.0, 3.0)}});
  const Wrench read = world.measured(), true_one = world.wrench();
  EXPECT_NEAR((read.force - true_one.force - Vector3(1.0, -2.0, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((read.moment - true_one.moment - Vector3(0.1, 0.0, -0.2)).norm(), 0.0, 1e-12);
}

TEST_F(MujocoWorldTest, AResetReturnsEverythingToTheStart) {
  MujocoWorld world(kScenes + "spacecraft.xml", {});
  const MujocoWorld fresh(kScenes + "spacecraft.xml", {});
  std::vector<double> goal = world.positions();
  goal[0] += 0.2;
  world.follow(goal);
  world.step(0.5);
  ASSERT_GT(std::abs(world.positions()[0] - fresh.positions()[0]), 0.05);
  world.reset();
  EXPECT_EQ(world.positions(), fresh.positions());
  EXPECT_EQ(world.speeds(), fresh.speeds());
  EXPECT_EQ(world.data().time, 0.0);
  world.step(0.1);  // where it is, it stays
  EXPECT_NEAR(world.positions()[0], fresh.positions()[0], 1e-6);
}

TEST_F(MujocoWorldTest, WhatIsUnsuitableIsRefusedWithFileAndName) {
  const auto has = [&](const std::string& text, const std::string& words, const MujocoOptions& options = {}) {
    const std::string said = refusal(text, options);
    EXPECT_EQ(said.find((folder_.path() / "scene.xml").string()), 0U) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  EXPECT_NE(error_of([] { MujocoWorld("/none.xml", {}); }).find("/none.xml: there is no such file"),
            std::string::npos);
  has("<mujoco><worldbody><geom sice=\"1\"/></worldbody></mujoco>\n", ":1: ");
  has("<mujoco><worldbody><geom sice=\"1\"/></worldbody></mujoco>\n", "(MuJoCo 2.2.2)");
  has(arm("", ""), "has no site \"tool\", which is the tool frame; its sites: none");
  has(arm(R"(<site name="hand"/>)", ""), "its sites: hand");
  has(arm(kSite, ""), "the site \"tool\" has no force sensor; add <force site=\"tool\"/> to <sensor>");
  has(arm(kSite, R"(<sensor><force site="tool"/></sensor>)"), "has no torque sensor");
  has(arm(R"(<joint name="own"/>)" + kSite, kSensors), "put the site into a body of its own without a joint");
  has(arm(kSite, kSensors, R"(<joint name="g" pos="0.1 0 0" axis="0 0 1"/>)"),
      "must have six joints between the world and the tool, but has 7: a, b, c, d, e, f, g");
  has(arm(kSite, kSensors), "has no actuator \"grip\"; its actuators: none", {.gripper = "grip"});
  std::string unlimited = arm(kSite, kSensors);
  unlimited.replace(unlimited.find("limited=\"true\""), 14, "limited=\"false\"");
  has(unlimited, "the joint a has no range");
}

TEST_F(MujocoWorldTest, ASimulationThatDivergesIsNamed) {
  std::string text = arm(kSite, kSensors);
  text.insert(
      text.find("</worldbody>"),
      R"(<body pos="1 0 0"><joint type="slide" axis="1 0 0" range="-1e9 1e9" limited="false" stiffness="-1e7" pos="0.1 0 0"/><geom size="0.1" mass="1e-3"/></body>)");
  text.insert(text.find("<worldbody>"), R"(<option gravity="1 0 0"/>)");
  MujocoWorld world(write(text), {});
  const std::string said = error_of([&] { world.step(5.0); });
  EXPECT_NE(said.find("scene.xml: the simulation diverges after"), std::string::npos) << said;
}

}  // namespace
}  // namespace longreach::mujoco_world_test
