// Surfaces in front of the robot of an MJCF file.

#include "deploy/mujoco/surfaces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "deploy/mujoco/world.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mujoco_surfaces_test {
namespace {

const std::string kScenes = std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/";

/// A tool on three slides along x, y and z. `geom`: how it collides.
std::string on_slides(const std::string& geom) {
  return R"(<mujoco model="slides"><option timestep="0.0005" gravity="0 0 0"/>
  <default><joint type="slide" limited="true" range="-1 1"/></default>
  <worldbody>
    <body><joint axis="1 0 0"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
    <body><joint axis="0 1 0"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
    <body><joint axis="0 0 1"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
      <body><site name="tool"/>)" +
         geom + R"(</body></body></body></body>
  </worldbody>
  <sensor><force site="tool"/><torque site="tool"/></sensor>
  <keyframe><key qpos="0.001 0 0" qvel="0 0 0"/></keyframe></mujoco>)";
}
const std::string kSphere = R"(<geom size="0.01" mass="0.04" friction="0.3"/>)";

class MujocoSurfaces : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string file = (folder_.path() / "slides.xml").string();
    std::ofstream(file) << text;
    return file;
  }
  TemporaryFolder folder_;
};

/// Moves the tool to `to` in 0.5 s, waits, and returns the force on it.
Vector3 pressed(MujocoWorld& world, const Vector3& to, double wait_s = 1.0) {
  const std::vector<double> start = world.positions();
  for (int i = 1; i <= 500 + std::lround(1e3 * wait_s); ++i) {
    std::array<double, 3> goal{};
    for (std::size_t k = 0; k < 3; ++k)
      goal[k] = start[k] + (to[static_cast<int>(k)] - start[k]) * std::min(1.0, i / 500.0);
    world.follow(goal);
    world.step(0.001);
  }
  Vector3 force = Vector3::Zero();
  for (const MujocoContact& contact : world.contacts()) force += contact.F_E_W.force;
  return force;
}

TEST_F(MujocoSurfaces, PressLikeTheirSpringsWhereTheSceneHasThem) {
  const std::string file = write(on_slides(kSphere));
  for (const double stiffness : {50.0, 1000.0, 7000.0, 1e6}) {
    MujocoSurface plate{.name = "plate", .only_x = true, .stiffness_n_per_m = stiffness};
    plate.half_m = {0.05, 1.0, 1.0};
    plate.X_WS = {{0.0, 0.02 + 0.05, 0.0}, Quaternion::FromTwoVectors(Vector3::UnitX(), -Vector3::UnitY())};
    MujocoWorld world(file, {.surfaces = {plate}});
    EXPECT_NEAR(world.positions()[0], 0.001, 1e-12);  // the key frame of the file
    EXPECT_EQ(pressed(world, {0.0, 0.019, 0.0}).norm(), 0.0) << stiffness;
    const Vector3 force = pressed(world, {0.0, 0.025, 0.0});
    const double depth_m = world.positions()[1] - 0.02;
    EXPECT_GT(depth_m, 0.0);
    ASSERT_EQ(world.contacts().size(), 1U);
    EXPECT_EQ(world.geom_name(world.contacts()[0].geom), "surface plate");
    // In series with MuJoCo's own contact, which the truth of the laboratory contains.
    const double compliance = 1.0 / stiffness + world.contacts()[0].depth_m / force.norm();
    EXPECT_NEAR(-force.y() * compliance, depth_m, 0.01 * depth_m) << stiffness;
    if (stiffness < 1e4)
      EXPECT_NEAR(-force.y(), stiffness * depth_m, 0.02 * stiffness * depth_m) << stiffness;
  }
}

TEST_F(MujocoSurfaces, ABlockHasSidesThatYieldToo) {
  MujocoSurface block{.name = "block", .half_m = {0.03, 0.02, 0.05}, .stiffness_n_per_m = 2000.0};
  block.X_WS.p = {0.1, 0.0, 0.0};
  MujocoWorld world(write(on_slides(kSphere)), {.surfaces = {block}});
  const Vector3 front = pressed(world, {0.073, 0.0, 0.0});
  // In series with MuJoCo's own contact.
  const auto give_m = [&world] { return world.contacts()[0].depth_m; };
  EXPECT_NEAR(front.x(), -2000.0 * (world.positions()[0] - 0.07 - give_m()), 0.01 * front.norm());
  for (const Vector3& via : {Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.04, 0.0), Vector3(0.1, 0.04, 0.0)})
    EXPECT_EQ(pressed(world, via).norm(), 0.0);
  const Vector3 side = pressed(world, {0.1, 0.017, 0.0});
  EXPECT_NEAR(side.y(), 2000.0 * (0.02 - world.positions()[1] - give_m()), 0.01 * side.norm());
  EXPECT_GT(side.y(), 2.0);
}

TEST_F(MujocoSurfaces, HaveTheFrictionOfTheToolOrThatOfTheFile) {
  const auto dragged = [this](const std::string& custom) {
    std::string text = on_slides(kSphere);
    text.insert(text.find("</mujoco>"), custom);
    MujocoSurface plate{.name = "plate", .only_x = true};
    plate.half_m = {0.05, 1.0, 1.0};
    plate.X_WS = {{0.0, 0.02 + 0.05, 0.0}, Quaternion::FromTwoVectors(Vector3::UnitX(), -Vector3::UnitY())};
    MujocoWorld world(write(text), {.surfaces = {plate}});
    pressed(world, {0.0, 0.025, 0.0});
    const Vector3 force = pressed(world, {0.03, 0.025, 0.0}, 0.0);
    EXPECT_LT(force.y(), -2.0);
    return std::abs(force.x() / force.y());
  };
  EXPECT_NEAR(dragged(""), 0.3, 0.01);
  EXPECT_LT(dragged(R"(<custom><numeric name="surface_friction" data="0"/></custom>)"),
            2e-5);  // MuJoCo has no less
  EXPECT_NEAR(dragged(R"(<custom><numeric name="surface_friction" data="0.6"/></custom>)"), 0.6, 0.02);
  EXPECT_THROW(dragged(R"(<custom><numeric name="surface_friction" data="-1"/></custom>)"),
               std::invalid_argument);
}

TEST_F(MujocoSurfaces, TouchTheToolAlone) {
  // Two plates that cross each other and the arm.
  MujocoSurface one{.name = "one", .only_x = true}, other{.name = "other", .only_x = true};
  one.half_m = other.half_m = {0.05, 1.0, 1.0};
  one.X_WS.p = {-0.2, 0.0, 0.0};
  other.X_WS = {{0.0, -0.2, 0.0}, Quaternion::FromTwoVectors(Vector3::UnitX(), Vector3::UnitY())};
  MujocoWorld world(kScenes + "free.xml", {.surfaces = {one, other}});
  world.step(1.0);
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_LT(world.wrench().force.norm(), 1e-9);
}

TEST_F(MujocoSurfaces, NeedASphereAsToolAndAThicknessOfTheTool) {
  const auto error_of = [](const std::string& file, const MujocoSurface& surface) -> std::string {
    try {
      const MujocoWorld world(file, {.surfaces = {surface}});
    } catch (const std::invalid_argument& problem) {
      return problem.what();
    }
    return "";
  };
  const MujocoSurface block{.name = "block"};
  for (const char* tool : {R"(<geom type="box" size="0.01 0.01 0.01" mass="1"/>)",
                           R"(<geom size="0.01" mass="1" pos="0 0 0.001"/>)",
                           R"(<geom size="0.01" mass="1"/><geom size="0.02" mass="1"/>)",
                           R"(<geom size="0.01" mass="1" contype="0" conaffinity="0"/>)"}) {
    const std::string file = write(on_slides(tool));
    EXPECT_EQ(error_of(file, block),
              file +
                  ": only one geom of the tool may collide, a sphere around its site, so that "
                  "surfaces can be put in front of it");
  }
  MujocoSurface sheet = block;
  sheet.half_m.z() = 0.001;
  EXPECT_EQ(error_of(write(on_slides(kSphere)), sheet), "block: is thinner than the tool");
  EXPECT_EQ(error_of(write(on_slides(kSphere)), block), "");
}

}  // namespace
}  // namespace longreach::mujoco_surfaces_test
