// Any text as a robot file: refused with a readable error, or a robot whose tool can be found, whose inverse
// stays within the joint limits, and that moves within them.

#include "tests/fuzz/robot_moves.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  proto::SlaveConfig config;
  config.mutable_scene();  // free space
  if (!fuzz::load(std::string(reinterpret_cast<const char*>(bytes), size), *config.mutable_robot())) return 0;
  if (config.robot().joint_size() == 0) return 0;  // then the robot is that of a file
  try {
    resolve_files(config, "");
  } catch (const ConfigError& error) {
    fuzz::require_readable(error, "robot");
    return 0;
  }
  // To move costs sixty times as much as to read: every 32nd robot does.
  if (size % 32 == 0) fuzz::move(to_struct(config));
  return 0;
}
