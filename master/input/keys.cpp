#include "master/input/keys.hpp"

namespace longreach {

void apply(const Key& key, const KeyboardConfig& config, MotionMode mode, KeyboardState& state) {
  OperatorRequests& requests = state.requests;
  switch (key.action) {
    case KeyAction::kMove:
      state.target_m[key.axis] += key.sign * (key.large ? config.large_step_m : config.step_m);
      state.target_m = clamp_norm(state.target_m, config.workspace_m);
      return;
    case KeyAction::kTurn:
      state.target_rad[key.axis] += key.sign * (key.large ? config.large_step_rad : config.step_rad);
      state.target_rad = clamp_norm(state.target_rad, config.workspace_rad);
      return;
    case KeyAction::kHome:
      state.target_m.setZero();
      state.target_rad.setZero();
      return;
    case KeyAction::kMode: {
      // Pressing the key twice between two polls restores the mode.
      const MotionMode from = requests.mode.value_or(mode);
      requests.mode = from == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
      return;
    }
    case KeyAction::kScaleUp:
      ++requests.scale_steps;
      return;
    case KeyAction::kScaleDown:
      --requests.scale_steps;
      return;
    case KeyAction::kKvUp:
      ++requests.kv_steps;
      return;
    case KeyAction::kKvDown:
      --requests.kv_steps;
      return;
    case KeyAction::kClutch:
      requests.clutch = !requests.clutch;
      return;
    case KeyAction::kGripper:
      requests.turns_gripper = !requests.turns_gripper;
      return;
    // If a stop is among the keys since the last poll, it takes precedence.
    case KeyAction::kEngage:
      requests.engage = !requests.stop;
      return;
    case KeyAction::kStop:
      requests.stop = true;
      requests.engage = false;
      return;
    case KeyAction::kQuit:
      state.quit = true;
      return;
    case KeyAction::kHelp:
      state.show_keys = !state.show_keys;
      return;
  }
}

std::string_view key_line() {
  return "w s / up down: x   a d / left right: y   r f / page up down: z   u o, i k, j l: turn about x, "
         "y, z   shift: large step   space: home   "
         "m: mode (rate: the hand returns home 2 s after the last key)   + -: scale   . ,: kv   c: clutch   g: gripper   "
         "e: engage   x: stop   q: quit   ?: keys";
}

}  // namespace longreach
