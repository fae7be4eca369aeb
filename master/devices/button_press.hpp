#pragma once
// Detects the presses of a button whose contacts chatter. A press counts once, when it begins, if the button has been
// released for the last 20 ms. A button that is held when its device appears counts when it is pressed again.

#include <algorithm>

namespace longreach {

class ButtonPress {
 public:
  /// Returns whether a press begins. `dt_s`: time since the last step, s.
  bool step(bool down, double dt_s) {
    constexpr double kReleased_s = 0.02, kRounding_s = 1e-6;
    const bool pressed = down && released_s_ >= kReleased_s - kRounding_s;
    released_s_ = down ? 0.0 : std::min(released_s_ + std::max(dt_s, 0.0), kReleased_s);
    return pressed;
  }
  /// The device is not available.
  void forget() { released_s_ = 0.0; }

 private:
  double released_s_ = 0.0;
};

}  // namespace longreach
