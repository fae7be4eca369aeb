#pragma once
// Operator at a gamepad, joystick or SpaceMouse. Poll it in one thread, outside the loop.

#include <optional>
#include <string>
#include <string_view>

#include "master/config/master_config.hpp"
#include "master/input/axis_hand.hpp"
#include "master/input/gamepad.hpp"
#include "master/input/space_mouse.hpp"

namespace longreach {

class PadOperator {
 public:
  static bool is_for(OperatorKind kind) {
    return kind == OperatorKind::kGamepad || kind == OperatorKind::kSpaceMouse;
  }

  /// Throws std::runtime_error if the library of the device cannot be loaded.
  explicit PadOperator(const MasterConfig& config);

  /// `felt`: force at the hand relative to the maximum rendered force, shown by the rumble motor. `dt_s`:
  /// since the last call.
  const AxisHandState& poll(MotionMode mode, double felt, double dt_s);

  /// Returns why the hand does not hold the handle, and a remedy; empty: it does.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] std::string_view key_line() const;

 private:
  OperatorConfig config_;
  std::optional<Gamepad> gamepad_;
  std::optional<SpaceMouse> space_mouse_;
  AxisHand hand_;
  AxisHandState last_{};
};

}  // namespace longreach
