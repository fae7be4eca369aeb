#pragma once
// A SpaceMouse, accessed through spacenavd: the six deflections of the puck and its buttons. libspnav is
// loaded when the first object is created; only one object may exist at a time. Poll it from a single thread,
// not from the loop. If the daemon ends, or reports that the device is unplugged, no device is present; the
// search for the daemon and the device then starts again.
//
//   push the puck away: x, to the left: y, up: z; rotations about the same axes

#include <memory>
#include <string>
#include <string_view>

#include "master/input/axis_hand.hpp"

namespace longreach {

class SpaceMouse {
 public:
  /// Throws std::runtime_error with a one-sentence message if libspnav cannot be loaded.
  SpaceMouse();
  ~SpaceMouse();
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  /// Returns the current state, `dt_s` after the last call. The call blocks only while connecting to a newly
  /// found daemon, for at most 0.7 s.
  AxisSample poll(double dt_s);

  /// Returns one line that lists the buttons.
  static std::string_view key_line();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
