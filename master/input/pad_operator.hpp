#pragma once
// The person at a gamepad, joystick or SpaceMouse. Poll it in one thread, outside the loop.

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

  /// Throws std::runtime_error where the library of the device cannot be loaded.
  explicit PadOperator(const MasterConfig& config);

  /// `felt`: force at the hand over the largest that is rendered, which a motor makes felt. `dt_s`: since the
  /// last call.
  const AxisHandState& poll(MotionMode mode, double felt, double dt_s);

  /// Why the hand holds nothing, and what to do; empty: it does.
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
