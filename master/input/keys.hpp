#pragma once
// Keys and their functions. Pure.
//
// Keys: w s or up, down: along x; a d or left, right: along y; r f or page up, page down: along z; u o, i k, j l: turn about
// x, y, z; with shift the large step; space: home; m: mode; + - scale; . , speed per deflection in rate mode (kv); c: clutch; g: open or close the gripper; e: engage; x:
// stop; q: quit; ?: show the keys. Other keys, such as Enter, have no function; in rate mode they only keep
// the hand from returning to its home position.

#include <string_view>

#include "common/spatial/spatial.hpp"
#include "master/master_node.hpp"

namespace longreach {

enum class KeyAction {
  kMove,  // one step along `axis`, in the direction `sign`
  kTurn,  // one step about `axis`
  kHome,
  kMode,
  kScaleUp,
  kScaleDown,
  kKvUp,
  kKvDown,
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
  bool large = false;  // use the large step

  bool operator==(const Key&) const = default;
};

struct KeyboardConfig {
  double step_m = 0.001;
  double large_step_m = 0.005;
  double step_rad = 0.01;
  double large_step_rad = 0.05;
  double workspace_m = 0.075;  // maximum distance of the target from home
  double workspace_rad = 0.8;  // maximum rotation from home
};

struct KeyboardState {
  Vector3 target_m = Vector3::Zero();    // target position of the hand, relative to the handle's home, M
  Vector3 target_rad = Vector3::Zero();  // target rotation vector, relative to the handle's home, M
  OperatorRequests requests{};           // requests since the last poll; the clutch is true while it is on
  bool show_keys = false;
  bool quit = false;  // latched
};

/// Applies `key` to `state`. `mode` is the current mode, which the mode key toggles.
void apply(const Key& key, const KeyboardConfig& config, MotionMode mode, KeyboardState& state);

/// Returns one line that lists the keys.
std::string_view key_line();

}  // namespace longreach
