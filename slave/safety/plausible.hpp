#pragma once
// Input checks of the slave node: joints must be finite, and goals must be possible. The force is checked
// separately (slave/sensing/sensor_watch.hpp).

#include "schema/state_link.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

inline bool finite(const RobotState& robot) {
  return robot.joint_rad.allFinite() && robot.joint_rad_per_s.allFinite();
}

/// True if the goal is finite and within 1 km and 100 rad.
inline bool possible(const MotionCommand& command) {
  constexpr double kGoalMaxM = 1e3, kGoalMaxRad = 100.0;
  return command.position_m.allFinite() && command.rotation_rad.allFinite() &&
         command.position_m.stableNorm() <= kGoalMaxM && command.rotation_rad.stableNorm() <= kGoalMaxRad;
}

}  // namespace longreach
