#pragma once
// Properties that every accepted robot must have, whatever its file contains: the pose of its tool is finite,
// and the robot moves within its joint limits.

#include <cmath>

#include "slave/command/motion.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace longreach::fuzz {
inline bool within_limits(const RobotConfig& robot, const JointVector& joint_rad) {
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& joint = robot.joint[static_cast<std::size_t>(i)];
    const bool fixed = joint.kind == JointKind::kFixed;
    if (!std::isfinite(joint_rad[i])) return false;
    if (!fixed && (joint_rad[i] < joint.min_rad - 1e-9 || joint_rad[i] > joint.max_rad + 1e-9)) return false;
  }
  return true;
}

inline void move(const SlaveConfig& config) {
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

}  // namespace longreach::fuzz
