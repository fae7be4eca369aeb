// Which bodies of an MJCF file are tracked, and where they are.

#include "deploy/mujoco/tracked_bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "deploy/mujoco/world.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::tracked_bodies_test {
namespace {

TEST(TrackedBodies, OfASceneAreWhereTheFileSays) {
  const MujocoWorld world(std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/spacecraft.xml", {});
  const TrackedBodies bodies(world.model());
  const adapter::BodiesDatagram sent = bodies.poses(world.data(), 0.25);
  ASSERT_EQ(sent.count, 1U);
  EXPECT_TRUE(bodies.any() && bodies.left_out().empty());
  EXPECT_NEAR(sent.body[0].position_m[0], 0.684, 1e-12);
  EXPECT_NEAR(sent.body[0].position_m[2], 0.539, 1e-12);
  EXPECT_NEAR(sent.body[0].orientation[0], 1.0, 1e-12);
  EXPECT_EQ(sent.body[0].age_s, 0.25);
  EXPECT_TRUE(adapter::finite(sent));
  EXPECT_FALSE(
      TrackedBodies(MujocoWorld(std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/wall.xml", {}).model())
          .any());
}

TEST(TrackedBodies, AreTheFirstEightInTheOrderOfTheFile) {
  std::string text = "<mujoco><worldbody><body><joint/><geom size='0.1'/></body>";
  for (int i = 0; i < 10; ++i)
    text += "<body name='body " + std::to_string(i) + "' pos='" + std::to_string(i) +
            " 0 0' quat='0 0 1 0'><freejoint/><geom size='0.1'/></body>";
  const TemporaryFolder folder;
  const std::string file = folder.write("ten.xml", text + "</worldbody></mujoco>").string();
  std::array<char, 500> error{};
  const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
      mj_loadXML(file.c_str(), nullptr, error.data(), error.size()), mj_deleteModel);
  ASSERT_TRUE(model) << error.data();
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), mj_deleteData);
  mj_forward(model.get(), data.get());
  const TrackedBodies bodies(*model);
  EXPECT_EQ(bodies.left_out(), (std::vector<std::string>{"body 8", "body 9"}));
  const adapter::BodiesDatagram sent = bodies.poses(*data, 0.0);
  ASSERT_EQ(sent.count, 8U);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(sent.body[i].position_m[0], i);
    EXPECT_EQ(sent.body[i].orientation[2], 1.0);
  }
}

}  // namespace
}  // namespace longreach::tracked_bodies_test
