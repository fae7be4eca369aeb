#pragma once
// Monitors the setpoints as the robot receives them: computes speed, acceleration and jerk from their
// differences, and compares these values with all limits. A position limit is violated by any excess, and
// every other limit by an excess of more than 1 %.

#include <cstdint>

#include "schema/config_slave.hpp"
#include "slave/command/limit_violations.hpp"
#include "slave/config/command_config.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

class LimitWatch {
 public:
  explicit LimitWatch(const RobotConfig& robot) : robot_(robot) {}

  /// Restarts at rest at this setpoint.
  void reset(const JointVector& joint_rad, const Pose& X_WE);
  /// `braking_m_per_s2`: permitted acceleration of the tool, if greater than that of `command`.
  void step(const JointVector& joint_rad, const Pose& X_WE, const CommandConfig& command, double dt,
            double braking_m_per_s2 = 0.0);

  [[nodiscard]] std::uint64_t violations() const { return violations_; }  // ticks with at least one violation
  [[nodiscard]] const LimitViolations& by_limit() const { return by_limit_; }

 private:
  using JointFlags = Eigen::Array<bool, kMaxJoints, 1>;

  void book(Limit limit, const JointFlags& exceeded);

  RobotConfig robot_;
  // Values of the previous tick.
  Pose X_WE_{};
  Twist V_WE_{};
  JointVector joint_rad_ = JointVector::Zero();
  JointVector joint_rad_per_s_ = JointVector::Zero();
  JointVector joint_rad_per_s2_ = JointVector::Zero();
  std::uint64_t violations_ = 0;
  LimitViolations by_limit_{};
  bool violated_ = false;  // a limit was violated in this tick
};

}  // namespace longreach
