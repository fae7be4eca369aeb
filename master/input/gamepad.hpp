#pragma once
// A gamepad or joystick. Only the joystick part of SDL is used: no window, no sound. SDL is loaded when the
// first object is created. Poll it from a single thread, not from the loop. A device that is plugged in while
// the program runs is used if no other device is in use.
//
//   gamepad    left stick: along x and y; right stick: along z, turn about z; triggers: turn about y
//   joystick   first two axes: along y and x; third axis or twist: along z; fourth: turn about z

#include <memory>
#include <string>

#include "master/input/axis_hand.hpp"

namespace longreach {

class Gamepad {
 public:
  /// Uses the first device whose name contains `name`, or the first one if `name` is empty. Throws
  /// std::runtime_error with a one-sentence message if SDL cannot be loaded.
  explicit Gamepad(const std::string& name);
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  /// Returns the current state without waiting.
  AxisSample poll();
  /// Runs the rumble motor with `strength`, 0 to 1, until the next call, but for at most 0.2 s. Returns false
  /// if the device has no motor.
  bool rumble(double strength);
  /// Returns the name that the device reports; empty if there is no device.
  [[nodiscard]] const std::string& name() const;

  /// Returns one line that lists sticks and buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
