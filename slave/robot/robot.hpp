#pragma once
// The interface between the loop and a robot: the robot returns the measured state, the poses of the free bodies
// that it tracks, if any, and accepts a joint setpoint. Without a setpoint the robot brakes within its limits and then holds its position by itself.

#include <optional>

#include "common/core/time.hpp"
#include "common/link/body_poses.hpp"
#include "common/spatial/joint_vector.hpp"
#include "schema/state_slave.hpp"

namespace longreach {

class Robot {
 public:
  virtual ~Robot() = default;
  virtual RobotState read(Time now) = 0;
  /// Returns the poses of free bodies at the last read(), with their ages. Empty: the robot tracks none.
  [[nodiscard]] virtual BodyPoses tracked_bodies() const { return {}; }
  /// Call this in every tick. Without a setpoint the robot brakes and holds its position.
  virtual void write(const std::optional<JointVector>& joint_setpoint_rad) = 0;
  /// Closes or opens the gripper. Called in every tick after the first request. A robot without a gripper
  /// ignores it.
  virtual void grip(bool /*closed*/) {}
};

}  // namespace longreach
