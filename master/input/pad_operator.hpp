#pragma once
// Operator with a gamepad, joystick or SpaceMouse. Poll it from a single thread, not from the loop.

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
  /// Returns whether this class handles operators of `kind`.
  static bool is_for(OperatorKind kind) {
    return kind == OperatorKind::kGamepad || kind == OperatorKind::kSpacemouse;
  }

  /// Throws std::runtime_error if the library for the device cannot be loaded.
  explicit PadOperator(const MasterConfig& config);

  /// Polls the device and returns the state of the hand. The rumble motor conveys `felt`, the force on the
  /// hand relative to the maximum rendered force. `dt_s` is the time since the last call, s.
  const AxisHandState& poll(MotionMode mode, double felt, double dt_s);

  /// See AxisHand::begin_at.
  void begin_at(const Vector3& target_m, const Vector3& target_rad) { hand_.begin_at(target_m, target_rad); }

  /// Returns why the hand does not hold the handle, and a remedy; empty if it does.
  [[nodiscard]] std::string trouble() const;
  /// Returns one line that lists the buttons of the device.
  [[nodiscard]] std::string_view key_line() const;

 private:
  OperatorConfig config_;
  std::optional<Gamepad> gamepad_;
  std::optional<SpaceMouse> space_mouse_;
  AxisHand hand_;
  AxisHandState last_{};
};

}  // namespace longreach
