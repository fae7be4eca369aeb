#pragma once
// Is the robot commanded in this tick?
//   Engaged, Holding  yes
//   Stopped, Fault    while it brakes, and 0.5 s on until its servos have come after; not if it is the
//                     robot that is at fault
//   else              no: it rests by its own brakes, whoever moves it, and the setpoint follows what is
//                     measured
// An engagement of a robot that is not commanded begins where it is, so it has to be at rest, in its
// workspace (the node sees to that), and within 1 mrad (mm) of its position limits; one that is commanded
// goes on from its setpoint, so it has to be there.

#include <cmath>

#include "common/link/stiffness_report.hpp"
#include "slave/config/robot_config.hpp"

namespace longreach {

class CommandAuthority {
 public:
  explicit CommandAuthority(const RobotConfig& robot) : robot_(robot) {}

  struct Input {
    SafetyState state = SafetyState::kIdle;
    bool robot_ok = true;         // and does what its setpoints say
    bool setpoint_rests = false;  // as last sent
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

  /// Why no engagement may begin; kNone: one may. `setpoint_rad`: of a robot that is commanded.
  [[nodiscard]] Reason why_not(const RobotState& robot, const JointVector& setpoint_rad) const {
    if (commands_) {
      const bool there = (robot.joint_rad - setpoint_rad).cwiseAbs().maxCoeff() <= kSetpointLost;
      return there ? HoldCause::kNone : HoldCause::kRobotTrackingLost;
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
  static constexpr double kSetpointLost = 0.05;  // rad: more than any servo lag
  static constexpr double kStillShare = 0.02;    // of its speed limit a joint at rest may be told to have
  static constexpr double kOutside = 1e-3;

  RobotConfig robot_;
  bool commands_ = false;
  double rested_s_ = 0.0;
};

}  // namespace longreach
