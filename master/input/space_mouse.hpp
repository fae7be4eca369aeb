#pragma once
// A SpaceMouse by spacenavd: the six deflections of the puck and its buttons. libspnav is loaded by the first
// object; one object at a time. Poll it in one thread, outside the loop. If the daemon ends, or reports that
// the device is unplugged, there is no device; both are searched again.
//
//   push the puck away: x, to the left: y, up: z; turns likewise

#include <memory>
#include <string>
#include <string_view>

#include "master/input/axis_hand.hpp"

namespace longreach {

class SpaceMouse {
 public:
  /// Throws std::runtime_error, one sentence, if libspnav cannot be loaded.
  SpaceMouse();
  ~SpaceMouse();
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  /// Returns the present state, `dt_s` after the last call. Waits only for a newly found daemon, at most 0.7
  /// s.
  AxisSample poll(double dt_s);

  /// One line that lists the buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
