#pragma once
// A SpaceMouse by spacenavd: the puck's six deflections and its buttons. libspnav is loaded by the first
// object, and by nobody else; one object at a time. Poll it in one thread, outside the loop. A daemon that
// ends, or reports that the device is unplugged, is a device that is not there; both are looked for again.
//
//   push the puck away: x, to the left: y, up: z; turns likewise

#include <memory>
#include <string>
#include <string_view>

#include "master/input/axis_hand.hpp"

namespace longreach {

class SpaceMouse {
 public:
  /// Throws std::runtime_error, one sentence, where libspnav cannot be loaded.
  SpaceMouse();
  ~SpaceMouse();
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  /// What it tells now, `dt_s` after the last call. Waits only for a daemon that has just been found, 0.7 s
  /// at most.
  AxisSample poll(double dt_s);

  /// One line that lists the buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
