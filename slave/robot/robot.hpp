#pragma once
// The interface between the loop and a robot: the robot returns the measured state and accepts a joint
// setpoint. Without a setpoint the robot brakes within its limits and then holds its position by itself.

#include <array>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/telemetry.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

using JointVector = Eigen::Matrix<double, kMaxJoints, 1>;

struct RobotState {
  JointVector joint_rad = JointVector::Zero();  // measured
  JointVector joint_rad_per_s = JointVector::Zero();
  Wrench F_F_W{};  // measured wrench of the environment on the tool, in W
  // false: the robot has failed, which latches a fault. A stop by the robot's own watchdog is not a failure;
  // it ends with the next setpoint.
  bool ok = true;
  bool load = false;   // the gripper holds a load
  double age_s = 0.0;  // time since the measurement or its arrival
};

class Robot {
 public:
  virtual ~Robot() = default;
  virtual RobotState read(Time now) = 0;
  /// Call this in every tick. Without a setpoint the robot brakes and holds its position.
  virtual void write(const std::optional<JointVector>& joint_setpoint_rad) = 0;
  /// Closes or opens the gripper. Called in every tick after the first request. A robot without a gripper
  /// ignores it.
  virtual void grip(bool /*closed*/) {}
};

}  // namespace longreach
