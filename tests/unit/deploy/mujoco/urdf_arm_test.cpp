// The arm of a URDF in MuJoCo: where the tool is, what its sensors measure, and what is left out.

#include "deploy/mujoco/urdf_arm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>

#include "common/config/robot/robot_file.hpp"
#include "deploy/mujoco/description.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::urdf_arm_test {
namespace {

constexpr double kGravity = 9.81;

std::string link(const std::string& name, double mass_kg, const std::string& more = "") {
  const std::string mass = std::to_string(mass_kg);
  return "<link name='" + name + "'>" +
         (mass_kg > 0.0
              ? "<inertial><mass value='" + mass +
                    "'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
              : std::string()) +
         more + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& origin, const std::string& axis = "0 0 1") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin " + origin + "/><axis xyz='" + axis +
         "'/><limit lower='-2.1' upper='2.3' velocity='1.5' effort='50'/></joint>\n";
}

const std::string kFlange = "<collision><geometry><sphere radius='0.03'/></geometry></collision>";

/// An arm with six joints and a flange of 0.5 kg, which the last joint moves; `more` is behind it.
std::string six(const std::string& more = "", const std::string& flange = kFlange) {
  return "<robot name='six'>\n" + link("base", 0) + link("l1", 3) + link("l2", 3) + link("l3", 2) +
         link("l4", 1) + link("l5", 1) + link("flange", 0.5, flange) +
         joint("j1", "revolute", "base", "l1", "xyz='0 0 0.123456789' rpy='0 0 0.3'") +
         joint("j2", "revolute", "l1", "l2", "xyz='0.05 0.1 0.2' rpy='-1.57 0 0'") +
         joint("j3", "revolute", "l2", "l3", "xyz='0.4 0 0'") +
         joint("j4", "continuous", "l3", "l4", "xyz='0.1 0.3333333333 0' rpy='1.2 0 0.1'") +
         joint("j5", "revolute", "l4", "l5", "xyz='0 0 0.1'", "0.6 0.8 0") +
         joint("j6", "revolute", "l5", "flange", "xyz='0 0.08 0' rpy='0 0.7 0'") + more + "</robot>\n";
}

class UrdfInMujoco : public ::testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.write("urdf/arm.urdf", text).string(); }
  std::string refusal(const std::string& text, const MujocoOptions& options = {}) {
    try {
      const MujocoWorld world(write(text), options);
    } catch (const std::invalid_argument& problem) {
      return problem.what();
    }
    return "";
  }
  void expect_refusal(const std::string& part, const std::string& text, const MujocoOptions& options = {}) {
    const std::string said = refusal(text, options);
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_TRUE(said.starts_with((folder_.path() / "urdf/arm.urdf").string()) || said.starts_with("robot."))
        << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  /// A cube of 40 mm, which consists of 12 triangles.
  static std::string binary_stl() {
    const std::array<std::array<int, 3>, 12> triangles{{{0, 2, 1},
                                                        {1, 2, 3},
                                                        {4, 5, 6},
                                                        {5, 7, 6},
                                                        {0, 1, 4},
                                                        {1, 5, 4},
                                                        {2, 6, 3},
                                                        {3, 6, 7},
                                                        {0, 4, 2},
                                                        {2, 4, 6},
                                                        {1, 3, 5},
                                                        {3, 7, 5}}};
    std::string bytes(80, ' ');
    const auto append = [&](const auto value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(std::uint32_t{12});
    for (const auto& triangle : triangles) {
      for (int i = 0; i < 3; ++i) append(0.0F);
      for (const int corner : triangle)
        for (const int bit : {1, 2, 4}) append((corner & bit) != 0 ? 0.02F : -0.02F);
      append(std::uint16_t{0});
    }
    return bytes;
  }

  TemporaryFolder folder_;
};

TEST_F(UrdfInMujoco, IsTheArmThatTheSlaveReads) {
  const std::string file =
      write(six(link("tcp", 0.0) + joint("fixed", "fixed", "flange", "tcp", "xyz='0 0 0.1'")));
  const proto::Robot read = read_robot_file(file, {}).robot;
  const MujocoWorld world(file, {});
  EXPECT_EQ(world.tool_link(), "tcp");
  require_same(read, "the slave's description", world, file);
  proto::Robot described = describe(world, file);
  require_same(described, "the description", world, file);
  EXPECT_EQ(described.joint(0).speed_max_rad_per_s(), 1.5);
  EXPECT_EQ(described.servo_hz(), 10.0);
  ASSERT_EQ(world.joints().size(), 6U);
  for (int i = 0; i < 6; ++i) {
    const MujocoJoint& joint = world.joints()[static_cast<std::size_t>(i)];
    EXPECT_EQ(joint.name, read.joint(i).name());
    EXPECT_EQ(joint.min, read.joint(i).min_rad()) << joint.name;
    EXPECT_EQ(joint.max, read.joint(i).max_rad()) << joint.name;
    EXPECT_EQ(joint.start, read.joint(i).start_rad()) << joint.name;
  }
}

TEST_F(UrdfInMujoco, SensorsOfAMovedToolLinkMeasureItsWeight) {
  MujocoWorld world(write(six()), {});
  EXPECT_EQ(world.tool_link(), "flange");
  world.step(1.0);
  const Pose X_WE = world.site_at(world.positions());
  EXPECT_LT((X_WE.q * world.wrench().force - Vector3(0, 0, -0.5 * kGravity)).norm(), 1e-3);
  EXPECT_LT(world.wrench().moment.norm(), 1e-3) << "no torque of the joint";
  EXPECT_TRUE(world.notes().empty());
}

TEST_F(UrdfInMujoco, FollowsSetpoints) {
  MujocoWorld world(write(six()), {});
  std::vector<double> goal = world.positions();
  for (double& q : goal) q += 0.1;
  world.follow(goal);
  world.step(2.0);
  for (std::size_t i = 0; i < goal.size(); ++i) EXPECT_NEAR(world.positions()[i], goal[i], 1e-3) << i;
}

TEST_F(UrdfInMujoco, TimeStepDividesAMillisecondOrIsThatOfTheFile) {
  EXPECT_EQ(MujocoWorld(write(six()), {}).time_step_s(), 5e-4);
  EXPECT_EQ(MujocoWorld(write(six("<mujoco><option timestep='0.00025'/></mujoco>")), {}).time_step_s(),
            2.5e-4);
}

TEST_F(UrdfInMujoco, ToolLinkIsNamedWhereThereAreTwo) {
  const std::string two = six(link("left", 0.1) + link("right", 0.1) +
                              joint("to_left", "fixed", "flange", "left", "xyz='0 0.1 0'") +
                              joint("to_right", "fixed", "flange", "right", "xyz='0 -0.1 0'"));
  expect_refusal("2 end links have 6 moving joints before them (left, right)", two);
  expect_refusal("has no such link", two, {.tool_link = "middle"});
  const MujocoWorld world(write(two), {.tool_link = "left"});
  EXPECT_EQ(world.tool_link(), "left");
  const MujocoWorld at_flange(write(two), {.tool_link = "flange"});
  const std::array<double, 6> zero{};
  const Pose X_FL = inverse(at_flange.site_at(zero)) * world.site_at(zero);
  EXPECT_LT((X_FL.p - Vector3(0, 0.1, 0)).norm(), 1e-12);
}

TEST_F(UrdfInMujoco, OtherJointsAreFixedAndNamed) {
  const MujocoWorld world(
      write(six(link("left", 0.1) + link("right", 0.1) + joint("open", "prismatic", "flange", "left", "") +
                joint("turn", "continuous", "l1", "right", "xyz='0 1 0'"))),
      {.tool_link = "flange"});
  EXPECT_EQ(world.model().nq, 6);
  ASSERT_EQ(world.notes().size(), 1U);
  EXPECT_TRUE(world.notes()[0].ends_with(
      ": joints that are not between the root and flange are fixed at zero: open, turn"))
      << world.notes()[0];
}

TEST_F(UrdfInMujoco, MeshesThatCannotBeReadAreLeftOutAndCounted) {
  const auto mesh = [](const std::string& name) {
    return "<collision><geometry><mesh filename='" + name + "'/></geometry></collision>";
  };
  folder_.write("meshes/tip.stl", binary_stl());
  const std::string package = folder_.path().filename().string();
  const std::string visual = "<visual><geometry><mesh filename='x.dae'/></geometry></visual>";
  const MujocoWorld world(
      write(six("", visual + mesh("package://" + package + "/meshes/tip.stl") + mesh("../meshes/tip.stl") +
                        mesh("tip.dae") + mesh("package://none/meshes/tip.stl"))),
      {});
  EXPECT_EQ(world.model().ngeom, 2);
  ASSERT_EQ(world.notes().size(), 1U);
  EXPECT_NE(world.notes()[0].find("meshes of collisions that are not simulated: 2;"), std::string::npos)
      << world.notes()[0];
  const MujocoWorld bare(write(six("", mesh("tip.dae"))), {});
  ASSERT_EQ(bare.notes().size(), 2U);
  EXPECT_EQ(bare.notes()[1],
            "the tool link flange carries no shape for collisions, so the sensors there measure no contact");
}

TEST_F(UrdfInMujoco, AnArmWithoutSixJointsIsRefused) {
  expect_refusal("longreach needs an arm with 6", "<robot name='one'>" + link("base", 0) + link("l1", 1) +
                                                      joint("j1", "revolute", "base", "l1", "xyz='0 0 0.1'") +
                                                      "</robot>");
  expect_refusal("mass and inertia of moving bodies",
                 six().replace(six().find("<mass value='3"), 14, "<mass value='0"));
}

TEST_F(UrdfInMujoco, AToolLinkOfAnMjcfFileIsRefused) {
  const std::string scene = std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/wall.xml";
  EXPECT_THROW(MujocoWorld(scene, {.tool_link = "tool"}), std::invalid_argument);
}

}  // namespace
}  // namespace longreach::urdf_arm_test
