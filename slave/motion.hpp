#pragma once
// From goal to joint setpoint: goal limiter, inverse kinematics, joint limits, and the watch over all of
// them.
//   Δq = clamp(IK(limited goal) - q);  slow-down of the next tick's tool speed before a joint limit has to
//   clamp
// The setpoint pose is always the one that the joints have, so nothing winds up when the robot cannot follow.
// Near a singular pose the tool slows down in proportion to its conditioning.

#include <cstdint>
#include <optional>

#include "slave/command/goal_limiter.hpp"
#include "slave/robot/inverse.hpp"

namespace longreach {

struct MotionInput {
  std::optional<Pose> X_WE_goal{};  // none: brake and stay
  ContactForce contact{};
  double dt = 0.0;  // > 0, s
};

class SlaveMotion {
 public:
  SlaveMotion(const CommandConfig& command, const RobotConfig& robot);

  void configure(const CommandConfig& command);
  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// Returns what had to be clamped.
  Clamps step(const MotionInput& input);

  [[nodiscard]] const JointVector& joint_setpoint_rad() const { return joint_rad_; }
  [[nodiscard]] const Pose& X_WE() const { return X_WE_; }  // of the setpoint
  [[nodiscard]] const Kinematics& kinematics() const { return inverse_.kinematics(); }
  [[nodiscard]] std::uint64_t limit_violations() const { return limit_violations_; }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }  // ticks without a solution

 private:
  void slow_down(const JointVector& joint_change_rad, double conditioning, double dt, Clamps& clamps);
  void watch(const JointVector& joint_before_rad, const Pose& X_WE_before, double dt);

  CommandConfig command_;
  RobotConfig robot_;
  Inverse inverse_;
  GoalLimiter limiter_;
  JointVector joint_rad_ = JointVector::Zero();
  Pose X_WE_{};
  double speed_share_ = 1.0;
  // For the watch: what was really asked for in the tick before.
  Twist V_WE_{};
  JointVector joint_rad_per_s_ = JointVector::Zero();
  std::uint64_t limit_violations_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace longreach
