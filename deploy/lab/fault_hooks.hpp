#pragma once
// Hooks between the nodes of a laboratory and their environment. They can observe and modify all data. Except
// for the clocks, each function is called once per tick. The default implementations change nothing.

#include "common/core/time.hpp"
#include "master/master_node.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class FaultHooks {
 public:
  virtual ~FaultHooks() = default;

  /// Returns the time since the start according to the clock of one side. It must never decrease.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// Returns true if the side skips this tick. The robot and the hand continue to move.
  virtual bool slave_skips_tick() { return false; }
  virtual bool master_skips_tick() { return false; }

  virtual void robot_reported(RobotState& /*told*/) {}      // robot state that the slave receives
  virtual void before_slave_step(SlaveInput& /*input*/) {}  // input of the slave node, before its step
  /// Output of the slave node, before it reaches the robot and the link.
  virtual void after_slave_step(SlaveOutput& /*out*/) {}
  virtual void handle_reported(HandleState& /*told*/) {}  // device state that the master receives
  virtual void before_master_step(MasterInput& /*input*/) {}
  virtual void after_master_step(MasterOutput& /*out*/) {}
};

}  // namespace longreach
