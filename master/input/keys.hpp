#pragma once
// Keys and their functions. Pure.
//
// Keys: w s or up down: along x; a d or left right: along y; r f or page up, page down: along z; with shift
// the large step; space: home; m: mode; + - scale; c clutch; g gripper closed or open; e engage;
// x stop; q quit; ? keys. Other keys, such as Enter, only keep the hand in place in rate mode.

#include <string_view>

#include "common/spatial/spatial.hpp"
#include "master/master_node.hpp"

namespace longreach {

enum class KeyAction {
  kMove,  // by `steps` along `axis`
  kHome,
  kMode,
  kScaleUp,
  kScaleDown,
  kClutch,
  kGripper,
  kEngage,
  kStop,
  kQuit,
  kHelp
};

struct Key {
  KeyAction action = KeyAction::kHome;
  int axis = 0;        // 0 x, 1 y, 2 z of M
  int sign = 0;        // -1, 0, +1
  bool large = false;  // the large step

  bool operator==(const Key&) const = default;
};

struct KeyboardConfig {
  double step_m = 0.001;
  double large_step_m = 0.005;
  double workspace_m = 0.075;  // maximum distance of the target from home
};

struct KeyboardState {
  Vector3 target_m = Vector3::Zero();  // target of the hand, from handle home, M
  OperatorRequests requests{};         // since the last poll; the clutch is a state
  bool show_keys = false;
  bool quit = false;  // latched
};

/// Applies `key` to `state`; `mode` is the present one, which the mode key changes.
void apply(const Key& key, const KeyboardConfig& config, MotionMode mode, KeyboardState& state);

/// One line that lists the keys.
std::string_view key_line();

}  // namespace longreach
