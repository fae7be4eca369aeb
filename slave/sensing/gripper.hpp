#pragma once
// The gripper is the robot's: closed or open as somebody asked last, and until then as the robot says.

#include <optional>

#include "common/link/telemetry.hpp"
#include "slave/robot/robot.hpp"
#include "slave/sensing/load_identifier.hpp"

namespace longreach {

class Gripper {
 public:
  void see(const RobotState& robot) { holds_ = robot.load; }
  /// None: nothing is asked. A hold or a silence asks for nothing, and drops nothing.
  void ask(const std::optional<bool>& closed) {
    if (closed) asked_ = closed;
  }
  [[nodiscard]] const std::optional<bool>& asked() const { return asked_; }
  [[nodiscard]] bool closed() const { return asked_.value_or(holds_); }
  /// Closed, or a robot that says that something is in it.
  [[nodiscard]] bool may_hold() const { return closed() || holds_; }
  [[nodiscard]] GripperState state(const LoadIdentifier& load) const {
    const bool known = load.known();
    return {closed(), holds_ || load.holds(), known ? load.load().mass_kg : 0.0, known ? load.sd_kg() : 0.0};
  }

 private:
  bool holds_ = false;           // as the robot says
  std::optional<bool> asked_{};  // none: nobody has
};

}  // namespace longreach
