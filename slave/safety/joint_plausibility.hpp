#pragma once
// Checks whether the reported joint positions and speeds are possible. Between two samples at an interval T
// they must satisfy
//   |Δq| <= 1.5 V (T + 20 ms) + 0.02 rad (or m),   |q̇| <= 10 V + 0.1 rad/s,   V the joint's speed limit
// Positions must also be within 0.1 rad of their limits, a margin larger than the oscillation of a link on a
// spring. After a jump, joint positions are accepted again only when they return to the last accepted
// position, or when the robot has recovered from a failure, after which it may be anywhere. Jumps below the
// bound and constant readings are not detected here; robot_watch detects constant readings once the setpoint
// has moved.

#include <cmath>
#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/hold_cause.hpp"
#include "schema/config_slave.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

class JointPlausibility {
 public:
  explicit JointPlausibility(const RobotConfig& robot) : robot_(robot) {}

  /// Returns the reason for the first implausible joint; no reason if all joints are plausible. `robot` must
  /// be ok and finite.
  Reason check(const RobotState& robot, Time now) {
    const Time measured = now - from_seconds(robot.age_s);
    Reason found;
    for (int i = 0; i < kMaxJoints && found == HoldCause::kNone; ++i) found = check_joint(i, robot, measured);
    if (found == HoldCause::kNone) {
      accepted_ = Sample{robot.joint_rad, measured};
      leapt_ = false;
    }
    leapt_ = leapt_ || found == HoldCause::kJointJumped;
    return found;
  }
  /// Call this when the robot has failed, because it may be moved before it works again.
  void forget() {
    accepted_.reset();
    leapt_ = false;
  }

 private:
  static constexpr double kSwiftShare = 1.5, kJitter_s = 0.02, kLeap = 0.02;
  static constexpr double kSpeedShare = 10.0, kSpeed = 0.1, kOutside = 0.1;

  struct Sample {
    JointVector rad;
    Time at;
  };

  [[nodiscard]] Reason check_joint(int i, const RobotState& robot, Time measured) const {
    const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
    const double q = robot.joint_rad[i];
    if (j.kind == JointKind::kFixed) return {};
    if (accepted_) {
      // After a jump, elapsed time does not make the position more plausible.
      const double apart_s = leapt_ ? 0.0 : std::max(0.0, to_seconds(measured - accepted_->at));
      const double from = accepted_->rad[i];
      if (std::abs(q - from) > kSwiftShare * j.speed_max_rad_per_s * (apart_s + kJitter_s) + kLeap)
        return {HoldCause::kJointJumped, i + 1, q, from};
    }
    if (q < j.min_rad - kOutside) return {HoldCause::kJointOutside, i + 1, q, j.min_rad};
    if (q > j.max_rad + kOutside) return {HoldCause::kJointOutside, i + 1, q, j.max_rad};
    if (std::abs(robot.joint_rad_per_s[i]) > kSpeedShare * j.speed_max_rad_per_s + kSpeed)
      return {HoldCause::kJointTooFast, i + 1, robot.joint_rad_per_s[i], j.speed_max_rad_per_s};
    return {};
  }

  RobotConfig robot_;
  std::optional<Sample> accepted_{};
  bool leapt_ = false;  // the joints jumped and have not returned
};

}  // namespace longreach
