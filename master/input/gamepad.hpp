#pragma once
// A gamepad or joystick by SDL's joystick part alone: no window, no sound. SDL is loaded by the first object,
// and by nobody else. Poll it in one thread, outside the loop. Plugged in while the program runs, one is
// taken as soon as there is none.
//
//   gamepad    left stick: along x and y; right stick: along z, turn about z; triggers: turn about y
//   joystick   first two axes: along y and x; third axis or twist: along z; fourth: turn about z

#include <memory>
#include <string>

#include "master/input/axis_hand.hpp"

namespace longreach {

class Gamepad {
 public:
  /// `name`: part of the name of the one to take; empty: the first. Throws std::runtime_error, one sentence,
  /// where SDL cannot be loaded.
  explicit Gamepad(const std::string& name);
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  /// What it tells now; never waits.
  AxisSample poll();
  /// `strength` 0 to 1, until the next call or for a fifth of a second. False: it has no motor.
  bool rumble(double strength);
  /// As it calls itself; empty: there is none.
  [[nodiscard]] const std::string& name() const;

  /// One line that lists sticks and buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
