#pragma once
// The one interface between the loop and a robot: measured state out, joint setpoint in. Without a setpoint
// the robot brakes within its limits and rests where it then is, by its own means.

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
  // false: the robot has failed, which latches a fault. A stop by its own watchdog is none: it ends with the
  // next setpoint.
  bool ok = true;
  bool load = false;   // the gripper holds something
  double age_s = 0.0;  // since this was measured, or came
};

class Robot {
 public:
  virtual ~Robot() = default;
  virtual RobotState read(Time now) = 0;
  /// In every tick; none: rest.
  virtual void write(const std::optional<JointVector>& joint_setpoint_rad) = 0;
  /// Closes or opens the gripper: a level, from when somebody asks on. A robot without one ignores it.
  virtual void grip(bool /*closed*/) {}
};

}  // namespace longreach
