// Free bodies of a scene in a MuJoCo world: contacts and grasp have the stiffness of the scene.

#include "deploy/mujoco/bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "deploy/mujoco/numbers.hpp"
#include "deploy/mujoco/surfaces.hpp"
#include "deploy/mujoco/world.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mujoco_bodies_test {
namespace {

/// A tool on three slides along x, y and z; its own finger touches nothing that is put in front of it.
const std::string kSlides = R"(<mujoco model="slides"><option timestep="0.0005" gravity="0 0 0"/>
  <default><joint type="slide" limited="true" range="-1 1"/></default>
  <worldbody>
    <body><joint axis="1 0 0"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
    <body><joint axis="0 1 0"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
    <body><joint axis="0 0 1"/><geom size="0.1" mass="2" contype="0" conaffinity="0"/>
      <include file="finger.xml"/></body></body></body>
  </worldbody>
  <sensor><force site="tool"/><torque site="tool"/></sensor>
  <keyframe><key qpos="0.001 0 0" qvel="0 0 0"/></keyframe></mujoco>)";
const std::string kFinger = R"(<mujocoinclude><body pos="0 0 0.1"><site name="tool" pos="0 0 0.05"/>
  <geom size="0.01" mass="0.04" pos="0 0 0.05"/></body></mujocoinclude>)";

/// The tool is a ball of 20 mm; in front of it, along x, a free ball of 2 kg, 5 mm away, and 10 mm behind it a wall.
SceneConfig ball_and_wall(const std::string& of_ball = "soft") {
  SceneConfig scene;
  scene.material = {{"soft", 1000.0, 0.001, 1.0, 0.5}, {"hard", 4000.0, 0.001, 1.0, 0.5}};
  scene.bodies.emplace();
  scene.bodies->mjcf_file = "ball.xml";
  scene.bodies->file = {
      {"ball.xml", R"(<mujoco><asset><material name="soft"/><material name="hard"/></asset><worldbody>
    <body name="tool"><freejoint/><geom size="0.02" material="hard"/></body>
    <body name="ball" pos="0.075 0 0"><freejoint/><geom name="ball" size="0.05" mass="2" material=")" +
                       of_ball + R"("/><site name="fixture" pos="-0.06 0 0"/></body>
    <body name="wall" pos="0.185 0 0"><geom name="wall" type="box" size="0.05 0.5 0.5" material="hard"/></body>
    </worldbody></mujoco>)"}};
  scene.bodies->gripper.emplace();
  return scene;
}

class MujocoBodiesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "slides.xml") << kSlides;
    std::ofstream(folder_.path() / "finger.xml") << kFinger;
  }
  [[nodiscard]] std::string file() const { return (folder_.path() / "slides.xml").string(); }
  TemporaryFolder folder_;
  Pose X_WE_start_{Vector3(0.001, 0.0, 0.15), Quaternion::Identity()};
};

/// Moves the tool along x to `to_m` in one second, and waits for one.
void press(MujocoWorld& world, double to_m) {
  const double from_m = world.positions()[0];
  for (int i = 1; i <= 2000; ++i) {
    world.follow(std::array{from_m + (to_m - from_m) * std::min(1.0, i / 1000.0), 0.0, 0.0});
    world.step(0.001);
  }
}

TEST_F(MujocoBodiesTest, PressWithTheSoftestMaterial) {
  for (const auto& [of_ball, stiffness] : {std::pair{"soft", 1000.0}, {"hard", 4000.0}}) {
    const MujocoBodies bodies(ball_and_wall(of_ball), X_WE_start_);
    MujocoWorld world(file(), {.force_noise_n = 0.0, .bodies = &bodies});
    press(world, 0.020);  // 15 mm to both contacts, then 4 mm
    const double force_n = -world.external_wrench().force.x();
    // Two contacts in series.
    double depth_m = 0.0;
    const mjData& d = world.data();
    for (int i = 0; i < d.ncon; ++i) depth_m = std::max(depth_m, -d.contact[i].dist);
    EXPECT_NEAR(force_n, 0.5 * stiffness * (world.positions()[0] - 0.016), 0.005 * force_n) << of_ball;
    EXPECT_NEAR(force_n, stiffness * depth_m, 0.005 * force_n) << of_ball;
    EXPECT_NEAR(world.wrench().force.x(), -force_n, 1e-3 * force_n);
    EXPECT_GT(force_n, 1.0);
  }
}

}  // namespace
}  // namespace longreach::mujoco_bodies_test
