// Any text as a scene file: refused with a readable error, when it is read or when the robot's start is
// known, or a scene whose forces are finite wherever the tool is.

#include <stdexcept>

#include "slave/simulation/scene/scene.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace longreach::fuzz {
namespace {

void touch(const SceneConfig& config) {
  Pose start;
  start.p = {0.1, -0.2, 0.3};
  const Scene scene(config, start);
  ToolMotion before;
  before.p_WE = start.p;
  for (int i = 0; i < 6; ++i) {
    ToolMotion tool = before;
    tool.t_s = 0.001 * i;
    tool.p_WE = start.p + Vector3(0.5 * i, -0.25 * i, 0.01 * i * i);
    tool.v_WE = {0.1, 0.0, -0.1 * i};
    tool.q_WE = Quaternion(1.0, 0.1 * i, 0.0, 0.2).normalized();
    const SceneContact contact = scene.contact(tool);
    require(contact.force_n.allFinite() && contact.moment_nm.allFinite(), "forces are finite");
    require(contact.depth_m >= 0.0, "a depth is not negative");
    const SceneMean mean = scene.mean_contact(before, tool, 1e-3);
    require(mean.wrench.allFinite() && mean.stiffness.allFinite(), "mean forces are finite");
    before = tool;
  }
}

}  // namespace
}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  proto::SlaveConfig config;
  if (!fuzz::load(std::string(reinterpret_cast<const char*>(bytes), size), *config.mutable_scene())) return 0;
  if (config.scene().has_bodies()) return 0;  // they are files of their own
  try {
    validate(config);
  } catch (const ConfigError& error) {
    fuzz::require_readable(error, "scene");
    return 0;
  }
  try {
    fuzz::touch(to_struct(config).scene);
  } catch (const std::invalid_argument& error) {
    fuzz::require_readable(ConfigError(error.what()), "path");
  }
  return 0;
}
