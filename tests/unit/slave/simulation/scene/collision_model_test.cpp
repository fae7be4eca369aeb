#include "slave/simulation/scene/collision_model.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "slave/simulation/scene/bodies.hpp"
#include "slave/simulation/scene/scene.hpp"
#include "tests/unit/slave/simulation/scene/bodies_scene.hpp"

namespace longreach::collision_model_test {
namespace {

using namespace test;

std::string refusal(const SceneConfig& scene) {
  try {
    const Bodies bodies(scene, Pose{});
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(CollisionModel, RefusesWhatIsNotToBeUsed) {
  const auto starts = [](const SceneConfig& scene, const std::string& text, const std::string& part) {
    const std::string why = refusal(scene);
    EXPECT_TRUE(why.starts_with(text)) << why;
    EXPECT_NE(why.find(part), std::string::npos) << why;
  };
  const std::string at = "scenes/test.xml:";
  starts(scene_of("<body name='tool'>\n<freejint/></body>"), at + "6: ", "freejint");
  starts(scene_of(kTool + "<body name='ghost'><freejoint/></body>"), at, "mass");
  starts(scene_of(star("a", "0 0 0")), at, "\"tool\"");
  starts(scene_of(kTool), at, "0 free bodies");
  starts(scene_of(kTool + "<body name='a'><joint type='hinge'/><geom size='1' material='hard'/></body>"), at,
         "neither free nor fixed");
  starts(scene_of(kTool + "<body name='a'><freejoint/><geom name='g' size='1'/></body>"), at,
         "the geom \"g\" has no material");
  std::string crowd = kTool + star("a", "0 0 0");
  for (int i = 0; i < 2000; ++i) crowd += "<geom size='0.01' pos='1 0 0' material='hard'/>\n";
  starts(scene_of(crowd), at, "12005 pairs of geoms");
  starts(with_gripper(kTool + star("a", "1 0 0")), at, "no site \"fixture\"");
}

// Whoever does not need MuJoCo does not pay for it.
TEST(CollisionModel, MuJoCoIsLoadedByTheFirstOfThemOnly) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own, in which no other test ran
  EXPECT_EXIT(
      {
        SceneConfig wall;
        wall.material.push_back({.name = "m"});
        wall.surface.push_back({.name = "w", .material = "m", .plane = PlaneConfig{}});
        const Scene scene(wall, Pose{});
        const bool before = CollisionModel::loaded();
        const Bodies bodies(scene_of(kTool + star("a", "1 0 0")), Pose{});
        std::exit(!before && CollisionModel::loaded() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

// MuJoCo omits contacts beyond what a file gives room for.
TEST(CollisionModel, FindsEveryContactWhateverRoomTheFileGives) {
  SceneConfig scene = scene_of(kTool + star("a", "0 0 0") +
                               "<geom type='plane' size='1 1 1' pos='0 0 -0.03' material='hard'/>\n");
  std::string& text = scene.bodies->file[0].text;
  text.insert(text.find("<asset>"), "<size nconmax='1'/>\n");
  CollisionModel model(scene);
  const Pose X[] = {Pose{}}, above{{5.0, 0.0, 1.0}, Quaternion::Identity()};
  EXPECT_EQ(model.near(X, above).size(), 4u);  // the four balls beside the one above
}

}  // namespace
}  // namespace longreach::collision_model_test
