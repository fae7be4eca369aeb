#pragma once
// Whoever sits between the nodes of a laboratory and all that is around them: sees what passes, and may
// change it. Each function is called once a tick of its side, in the order of the tick; without a meddler
// nothing is.

#include "common/core/time.hpp"
#include "master/master_node.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class Meddler {
 public:
  virtual ~Meddler() = default;

  /// A side's own clock, since the start; it never goes back.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// The side does not run in this tick; robot and hand go on.
  virtual bool slave_sleeps() { return false; }
  virtual bool master_sleeps() { return false; }

  virtual void robot_told(RobotState& /*told*/) {}      // what the slave is told of the robot
  virtual void slave_asked(SlaveInput& /*input*/) {}    // before its node's step
  virtual void slave_answered(SlaveOutput& /*out*/) {}  // before robot and wire get it
  virtual void handle_told(HandleState& /*told*/) {}    // what the master is told of the devices
  virtual void master_asked(MasterInput& /*input*/) {}
  virtual void master_answered(MasterOutput& /*out*/) {}
};

}  // namespace longreach
