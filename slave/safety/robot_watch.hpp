#pragma once
// Checks, using only the measured joint positions q, whether the robot follows its setpoints:
//   x' = 2π f (s - x)   expected position of a joint with a servo of bandwidth f, s the setpoint
//   tracking_lost       a joint deviates from x by more than 0.1 rad (or m) for half a second
//   uncommanded_motion  a joint is faster than a tenth of its speed limit for half a second and 3/(2π f),
//                       while its setpoint is at rest
// The bounds are larger than the deflection of a joint and longer than a stop by the robot's own watchdog
// after a late tick. If a joint deviates by more than the bound after a stall on this side, it was moved
// during the stall; tracking_lost is then set immediately, so that the joint is not driven back. Smaller
// deviations are not detected: a slow drift is detected only when it reaches the bound of tracking_lost.

#include <cmath>
#include <numbers>

#include "schema/config_slave.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

class RobotWatch {
 public:
  explicit RobotWatch(const RobotConfig& robot)
      : rate_per_s_(2.0 * std::numbers::pi * robot.servo_hz),
        settling_s_(rate_per_s_ > 0.0 ? 3.0 / rate_per_s_ : 0.0) {
    for (int i = 0; i < kMaxJoints; ++i)
      brisk_rad_per_s_[i] = 0.1 * robot.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
  }

  /// `commanded`: the robot must follow the setpoint; otherwise it may be anywhere. `rests`: the setpoint
  /// does not change. `dt` > 0: time since the previous setpoint, s. `stood`: there was no setpoint for
  /// longer than the gap timer.
  void step(const RobotState& robot, const JointVector& setpoint_rad, bool commanded, bool rests, double dt,
            bool stood = false) {
    if (!commanded) expected_rad_ = robot.joint_rad;
    if (rate_per_s_ > 0.0) {
      expected_rad_ -= std::expm1(-rate_per_s_ * dt) * (setpoint_rad - expected_rad_);
    } else {
      expected_rad_ = setpoint_rad;
    }
    const bool off = ((robot.joint_rad - expected_rad_).cwiseAbs().array() > kOff).any();
    off_s_ = commanded && off ? off_s_ + (stood ? kLong_s : 0.0) + dt : 0.0;
    const bool moves = (robot.joint_rad_per_s.cwiseAbs().array() > brisk_rad_per_s_.array()).any();
    moves_s_ = rests && moves ? moves_s_ + dt : 0.0;
  }

  [[nodiscard]] bool tracking_lost() const { return off_s_ > kLong_s; }
  [[nodiscard]] bool uncommanded_motion() const { return moves_s_ > kLong_s + settling_s_; }

 private:
  static constexpr double kOff = 0.1;
  static constexpr double kLong_s = 0.5;

  double rate_per_s_;
  double settling_s_;
  JointVector brisk_rad_per_s_ = JointVector::Zero();
  JointVector expected_rad_ = JointVector::Zero();
  double off_s_ = 0.0, moves_s_ = 0.0;
};

}  // namespace longreach
