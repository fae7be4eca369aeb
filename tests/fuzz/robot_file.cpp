// Any text as a robot file: refused with a readable error, or a robot whose tool can be found, whose inverse
// stays within the joint limits, and that moves within them.

#include <cmath>

#include "slave/command/motion.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace longreach::fuzz {
namespace {

bool within_limits(const RobotConfig& robot, const JointVector& joint_rad) {
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& joint = robot.joint[static_cast<std::size_t>(i)];
    const bool fixed = joint.kind == JointKind::kFixed;
    if (!std::isfinite(joint_rad[i])) return false;
    if (!fixed && (joint_rad[i] < joint.min_rad - 1e-9 || joint_rad[i] > joint.max_rad + 1e-9)) return false;
  }
  return true;
}

void move(const SlaveConfig& config) {
  JointVector start_rad;
  for (int i = 0; i < kMaxJoints; ++i)
    start_rad[i] = config.robot.joint[static_cast<std::size_t>(i)].start_rad;
  SlaveMotion motion(config.command, config.robot);
  motion.reset(start_rad);
  const Pose start = motion.X_WE();
  require(start.p.allFinite() && start.q.coeffs().allFinite(), "the tool is somewhere");
  Pose goal = start;
  goal.p.x() += 0.01;
  for (int i = 0; i < 3; ++i) {
    motion.step({goal, {}, 1.0 / config.loop.rate_hz});
    require(within_limits(config.robot, motion.joint_setpoint_rad()), "joints keep their limits");
    require(motion.X_WE().p.allFinite(), "the tool is somewhere");
  }
}

}  // namespace
}  // namespace longreach::fuzz

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
