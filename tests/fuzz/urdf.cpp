// Any text as a URDF: refused with a readable error, or a robot that moves within its limits.

#include "common/config/urdf.hpp"

#include "tests/fuzz/robot_moves.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  proto::SlaveConfig config;
  config.mutable_scene();  // free space
  try {
    *config.mutable_robot() =
        read_urdf("text", std::string(reinterpret_cast<const char*>(bytes), size), proto::Robot());
    resolve_files(config, "");
  } catch (const ConfigError& error) {
    fuzz::require_readable(error, "");
    return 0;
  }
  // To move costs far more than to read: every 32nd robot does.
  if (size % 32 == 0) fuzz::move(to_struct(config));
  return 0;
}
