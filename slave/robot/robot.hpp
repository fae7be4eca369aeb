#pragma once
// The interface between the loop and a robot: measured state out, joint setpoint in. Without a setpoint the
// robot brakes within its limits and then stays in place by its own means.

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
  Wrench F_F_W{};  // force sensor, in W, by the environment on the tool
  // false: the robot has failed, which latches a fault. A stop by its own watchdog is not a failure: it ends
  // with the next setpoint.
  bool ok = true;
  bool load = false;   // the gripper holds a load
  double age_s = 0.0;  // since the measurement, or its arrival
};

class Robot {
 public:
  virtual ~Robot() = default;
  virtual RobotState read(Time now) = 0;
  /// Call it in every tick; none: stay in place.
  virtual void write(const std::optional<JointVector>& joint_setpoint_rad) = 0;
  /// Closes or opens the gripper; called in every tick once requested. A robot without a gripper ignores it.
  virtual void grip(bool /*closed*/) {}
};

}  // namespace longreach
