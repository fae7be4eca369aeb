// Any text as a URDF: refused with a readable error, or a robot that moves within its limits.

#include "common/config/robot/urdf.hpp"

#include "tests/fuzz/robot_moves.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  proto::SlaveConfig config;
  config.mutable_scene();  // free space
  std::vector<std::string> ignored;
  try {
    *config.mutable_robot() =
        read_urdf("text", std::string(reinterpret_cast<const char*>(bytes), size), proto::Robot(), &ignored);
    for (const std::string& sentence : ignored) fuzz::require_readable(ConfigError(sentence), "text");
    for (const std::string& sentence : ignored)
      fuzz::require(ConfigError(sentence).what() == sentence, "a note has only printable characters");
    resolve_files(config, "");
  } catch (const ConfigError& error) {
    fuzz::require_readable(error, "");
    return 0;
  }
  // To move costs far more than to read: every 32nd robot does.
  if (size % 32 == 0) fuzz::move(to_struct(config));
  return 0;
}
