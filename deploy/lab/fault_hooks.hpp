#pragma once
// Hooks between the nodes of a laboratory and their environment, which can observe and change all data. Each
// function is called once per tick of its side, in the order of the tick. Without hooks nothing is changed.

#include "common/core/time.hpp"
#include "master/master_node.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class FaultHooks {
 public:
  virtual ~FaultHooks() = default;

  /// The clock of a side, since the start; it never goes back.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// The side does not run in this tick; robot and hand continue.
  virtual bool slave_skips_tick() { return false; }
  virtual bool master_skips_tick() { return false; }

  virtual void robot_reported(RobotState& /*told*/) {}      // the state of the robot that the slave receives
  virtual void before_slave_step(SlaveInput& /*input*/) {}  // before the step of its node
  virtual void after_slave_step(SlaveOutput& /*out*/) {}    // before robot and link receive it
  virtual void handle_reported(HandleState& /*told*/) {}  // the state of the devices that the master receives
  virtual void before_master_step(MasterInput& /*input*/) {}
  virtual void after_master_step(MasterOutput& /*out*/) {}
};

}  // namespace longreach
