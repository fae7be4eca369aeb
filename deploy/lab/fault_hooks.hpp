#pragma once
// Whoever sits between the nodes of a laboratory and all that is around them: sees what passes, and may
// change it. Each function is called once a tick of its side, in the order of the tick; without a meddler
// nothing is.

#include "common/core/time.hpp"
#include "master/master_node.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class FaultHooks {
 public:
  virtual ~FaultHooks() = default;

  /// A side's own clock, since the start; it never goes back.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// The side does not run in this tick; robot and hand go on.
  virtual bool slave_skips_tick() { return false; }
  virtual bool master_skips_tick() { return false; }

  virtual void robot_reported(RobotState& /*told*/) {}      // what the slave is told of the robot
  virtual void before_slave_step(SlaveInput& /*input*/) {}  // before its node's step
  virtual void after_slave_step(SlaveOutput& /*out*/) {}    // before robot and wire get it
  virtual void handle_reported(HandleState& /*told*/) {}    // what the master is told of the devices
  virtual void before_master_step(MasterInput& /*input*/) {}
  virtual void after_master_step(MasterOutput& /*out*/) {}
};

}  // namespace longreach
