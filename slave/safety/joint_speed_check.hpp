#pragma once
// Detects that a robot reports no joint speeds: every reported speed has been zero although the joints have moved.

#include <optional>

#include "slave/robot/robot.hpp"

namespace longreach {

class JointSpeedCheck {
 public:
  void step(const RobotState& robot) {
    constexpr double kMoved = 0.02;  // rad or m
    reported_ = reported_ || !robot.joint_rad_per_s.isZero(0.0);
    if (!first_rad_) first_rad_ = robot.joint_rad;
    moved_ = moved_ || (robot.joint_rad - *first_rad_).cwiseAbs().maxCoeff() > kMoved;
  }
  [[nodiscard]] bool missing() const { return moved_ && !reported_; }

 private:
  std::optional<JointVector> first_rad_{};
  bool reported_ = false, moved_ = false;
};

}  // namespace longreach
