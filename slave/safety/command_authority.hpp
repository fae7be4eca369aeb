#pragma once
// Decides whether the robot is commanded in this tick:
//   Engaged, Holding  yes
//   Stopped, Fault    yes, while it brakes and for another 0.5 s until its servos have settled;
//                     no, if the robot itself has failed
//   otherwise         no: its own brakes hold it, it may be moved externally, and the setpoint follows the
//                     measured position
// An engagement of an uncommanded robot starts at its measured position. The robot must then be at rest, in
// its workspace (checked by the node), and at most 1 mrad (or 1 mm) outside its position limits. An
// engagement of a commanded robot starts at its setpoint, so the robot must be at that setpoint.

#include <cmath>

#include "common/link/stiffness_report.hpp"
#include "schema/config_slave.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

class CommandAuthority {
 public:
  explicit CommandAuthority(const RobotConfig& robot) : robot_(robot) {}

  struct Input {
    SafetyState state = SafetyState::kIdle;
    bool robot_ok = true;         // the robot is ok and follows its setpoints
    bool setpoint_rests = false;  // the last setpoint is at rest
    double dt = 0.0;              // s
  };
  void step(const Input& in) {
    rested_s_ = in.setpoint_rests ? rested_s_ + in.dt : 0.0;
    if (in.state == SafetyState::kEngaged || in.state == SafetyState::kHolding) {
      commands_ = true;
      return;
    }
    const bool stops = in.state == SafetyState::kStopped || in.state == SafetyState::kFault;
    commands_ = commands_ && stops && in.robot_ok && rested_s_ < kRest_s;
  }
  [[nodiscard]] bool commands() const { return commands_; }

  /// Returns the reason why no engagement may start, or kNone if one may start. `setpoint_rad` is the current
  /// setpoint of a commanded robot.
  [[nodiscard]] Reason why_not(const RobotState& robot, const JointVector& setpoint_rad) const {
    if (commands_) {
      const bool there = (robot.joint_rad - setpoint_rad).cwiseAbs().maxCoeff() <= kSetpointLost;
      return there ? HoldCause::kNone : HoldCause::kTrackingLost;
    }
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
      if (j.kind == JointKind::kFixed) continue;
      const double q = robot.joint_rad[i], speed = robot.joint_rad_per_s[i];
      const double still = kStillShare * j.speed_max_rad_per_s;
      if (std::abs(speed) > still) return {HoldCause::kRobotMoves, i + 1, speed, still};
      if (q < j.min_rad - kOutside) return {HoldCause::kJointLimit, i + 1, q, j.min_rad};
      if (q > j.max_rad + kOutside) return {HoldCause::kJointLimit, i + 1, q, j.max_rad};
    }
    return {};
  }

 private:
  static constexpr double kRest_s = 0.5;
  static constexpr double kSetpointLost = 0.05;  // rad; larger than the lag of any servo
  /// Maximum speed that a joint at rest may report, as a fraction of its speed limit.
  static constexpr double kStillShare = 0.02;
  static constexpr double kOutside = 1e-3;

  RobotConfig robot_;
  bool commands_ = false;
  double rested_s_ = 0.0;
};

}  // namespace longreach
