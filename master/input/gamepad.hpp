#pragma once
// A gamepad or joystick, using only the joystick part of SDL: no window, no sound. SDL is loaded by the first
// object. Poll it in one thread, outside the loop. A device that is plugged in while the program runs is used
// if there is no other.
//
//   gamepad    left stick: along x and y; right stick: along z, turn about z; triggers: turn about y
//   joystick   first two axes: along y and x; third axis or twist: along z; fourth: turn about z

#include <memory>
#include <string>

#include "master/input/axis_hand.hpp"

namespace longreach {

class Gamepad {
 public:
  /// `name`: part of the name of the device to use; empty: the first. Throws std::runtime_error, one
  /// sentence, if SDL cannot be loaded.
  explicit Gamepad(const std::string& name);
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  /// Returns the present state; never waits.
  AxisSample poll();
  /// `strength` 0 to 1, until the next call or for a fifth of a second. Returns false if the device has no
  /// motor.
  bool rumble(double strength);
  /// Name reported by the device; empty: there is none.
  [[nodiscard]] const std::string& name() const;

  /// One line that lists sticks and buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
