#pragma once
// From goal to joint setpoint:
//   goal -> tool limits (goal_limiter) -> inverse kinematics -> joint limits (joint_limiter) -> setpoint
// What the joints cannot do is taken back from the tool limiter at once: its pose and velocity are those of
// the joints' path, so nothing winds up. Before that happens the tool slows down: when a joint nears its
// speed, and near a singular pose in proportion to its conditioning, unless it is on the way out. Right
// beside a singular pose the joints go through it by self motion, and the tool may leave its way by about
// half a per cent of the reach, instead of the arm being led around. Every setpoint is watched from outside,
// by differences. Tool limits hold as far as the joints let the tool keep them: a joint that must brake comes
// first.

#include <cstdint>
#include <optional>

#include "slave/command/goal_limiter.hpp"
#include "slave/command/joint_limiter.hpp"
#include "slave/limit_watch.hpp"
#include "slave/robot/inverse.hpp"

namespace longreach {

struct MotionInput {
  std::optional<Pose> X_WE_goal{};  // none: brake and stay
  ContactForce contact{};
  double dt = 0.0;  // > 0, s, the same in every step
};

class SlaveMotion {
 public:
  SlaveMotion(const CommandConfig& command, const RobotConfig& robot);

  void configure(const CommandConfig& command);
  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// Returns what had to be clamped.
  Clamps step(const MotionInput& input);

  [[nodiscard]] const JointVector& joint_setpoint_rad() const { return joints_.setpoint_rad(); }
  [[nodiscard]] const Pose& X_WE() const { return X_WE_; }  // of the setpoint
  [[nodiscard]] const Kinematics& kinematics() const { return inverse_.kinematics(); }
  [[nodiscard]] std::uint64_t limit_violations() const { return watch_.violations(); }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }  // ticks without a solution

 private:
  [[nodiscard]] InverseResult invert(const Pose& X_WE, const MotionInput& input);
  [[nodiscard]] double ticks_for(const JointVector& way_rad, double dt) const;
  [[nodiscard]] bool leads_nearer(const JointVector& way_rad, const Rigid& X_WE_goal) const;
  [[nodiscard]] ToolBound tool_bound() const;
  void slow_down(const JointVector& rad_per_s, double conditioning, double dt, Clamps& clamps);

  CommandConfig command_;
  RobotConfig robot_;
  Inverse inverse_;
  GoalLimiter limiter_;
  JointLimiter joints_;
  LimitWatch watch_;
  Pose X_WE_{};
  double speed_share_ = 1.0;
  bool turning_ = false;       // on a way of the joints to another solution
  double conditioning_ = 0.0;  // of the tick before
  std::uint64_t failures_ = 0;
};

}  // namespace longreach
