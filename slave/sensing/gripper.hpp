#pragma once
// State of the gripper, which is part of the robot: the last requested state or, before any request, the
// state that the robot reports.

#include <optional>

#include "schema/state_link.hpp"
#include "slave/robot/robot.hpp"
#include "slave/sensing/load_identifier.hpp"

namespace longreach {

class Gripper {
 public:
  void see(const RobotState& robot) { holds_ = robot.load; }
  /// Requests a state; std::nullopt is no request. Neither a hold nor an interrupted link changes the request.
  void ask(const std::optional<bool>& closed) {
    if (closed) asked_ = closed;
  }
  [[nodiscard]] const std::optional<bool>& asked() const { return asked_; }
  [[nodiscard]] bool closed() const { return asked_.value_or(holds_); }
  /// True if the gripper is closed or the robot reports that it holds a load.
  [[nodiscard]] bool may_hold() const { return closed() || holds_; }
  [[nodiscard]] GripperState state(const LoadIdentifier& load) const {
    const bool measured = load.measured();
    return {.holds = holds_ || load.holds(),
            .closed = closed(),
            .load_kg = measured ? load.load().mass_kg : 0.0,
            .load_sd_kg = measured ? load.sd_kg() : 0.0};
  }

 private:
  bool holds_ = false;           // the robot reports that it holds a load
  std::optional<bool> asked_{};  // unset: not requested yet
};

}  // namespace longreach
