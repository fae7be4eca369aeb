#include "master/input/pad_operator.hpp"

namespace longreach {

PadOperator::PadOperator(const MasterConfig& config)
    : config_(config.operator_), hand_(axis_hand_config(config.operator_, config.device)) {
  if (config_.kind == OperatorKind::kGamepad) {
    gamepad_.emplace(config_.pad);
  } else {
    space_mouse_.emplace();
  }
}

const AxisHandState& PadOperator::poll(MotionMode mode, double felt, double dt_s) {
  const AxisSample sample = gamepad_ ? gamepad_->poll() : space_mouse_->poll(dt_s);
  if (gamepad_ && config_.rumble > 0.0) gamepad_->rumble(config_.rumble * felt);
  last_ = hand_.step(sample, mode, dt_s);
  return last_;
}

std::string PadOperator::trouble() const {
  if (last_.silent)
    return gamepad_
               ? "the gamepad sends no new reports and is treated as released; move or release the sticks"
               : "the SpaceMouse sends no new reports and is treated as released; move or release the puck";
  if (last_.armed) return "";
  if (last_.level.present) {
    return gamepad_ ? "the sticks are not centred; release them once"
                    : "the puck is not centred; release it once";
  }
  if (space_mouse_) return "no SpaceMouse found; plug it in and start spacenavd, then engage";
  if (config_.pad.empty()) return "no gamepad or joystick found; plug it in, then engage";
  return "no gamepad or joystick found with \"" + config_.pad + "\" in its name; plug it in, then engage";
}

std::string_view PadOperator::key_line() const {
  return gamepad_ ? Gamepad::key_line() : SpaceMouse::key_line();
}

}  // namespace longreach
