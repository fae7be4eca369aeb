#pragma once
// Scenes with free bodies for tests, given as MJCF text.

#include <string>

#include "schema/config_scene.hpp"

namespace longreach::test {

inline SceneConfig scene_of(const std::string& world, double stiffness = 1e5, double damping = 0.0) {
  SceneConfig scene;
  scene.material = {{"hard", stiffness, 0.001, 1.5, damping}};
  scene.bodies.emplace();
  scene.bodies->mjcf_file = "scenes/test.xml";
  scene.bodies->file = {{"scenes/test.xml",
                         "<mujoco>\n<option gravity='0 0 0'/>\n"
                         "<asset><material name='hard'/></asset>\n<worldbody>\n" +
                             world + "</worldbody>\n</mujoco>\n"}};
  return scene;
}

inline const Pose kAway{{5.0, 0.0, 0.0}, Quaternion::Identity()};
inline const std::string kTool =
    "<body name='tool'><freejoint/><geom type='sphere' size='0.02' mass='1' material='hard'/></body>\n";

inline std::string balls() {
  std::string text;
  for (const char* at : {"0.1 0 0", "-0.1 0 0", "0 0.1 0", "0 -0.1 0", "0 0 0.12"})
    text += std::string("<geom type='sphere' size='0.04' mass='2' material='hard' pos='") + at + "'/>";
  return text;
}

inline std::string star(const std::string& name, const std::string& at) {
  return "<body name='" + name + "' pos='" + at + "'><freejoint/>" + balls() + "</body>\n";
}

inline SceneConfig with_gripper(const std::string& world) {
  SceneConfig scene = scene_of(world);
  scene.bodies->gripper.emplace();
  return scene;
}

}  // namespace longreach::test
