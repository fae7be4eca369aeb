#pragma once
// The watch over the setpoints: their differences against every limit, as the robot sees them. A limit counts
// as exceeded by more than 1 %, a position limit by anything.

#include <cstdint>

#include "slave/command/command_config.hpp"
#include "slave/robot/robot_config.hpp"

namespace longreach {

class LimitWatch {
 public:
  explicit LimitWatch(const RobotConfig& robot) : robot_(robot) {}

  /// Begins at rest.
  void reset(const JointVector& joint_rad, const Pose& X_WE);
  void step(const JointVector& joint_rad, const Pose& X_WE, const CommandConfig& command, double dt);

  [[nodiscard]] std::uint64_t violations() const { return violations_; }  // ticks

 private:
  RobotConfig robot_;
  // Of the tick before.
  Pose X_WE_{};
  Twist V_WE_{};
  JointVector joint_rad_ = JointVector::Zero();
  JointVector joint_rad_per_s_ = JointVector::Zero();
  JointVector joint_rad_per_s2_ = JointVector::Zero();
  std::uint64_t violations_ = 0;
};

}  // namespace longreach
