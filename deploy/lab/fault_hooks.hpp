#pragma once
// Hooks between the nodes of a laboratory and their environment, which can observe and modify all data.
// Except for the clocks, each function is called once per tick. The default implementations change nothing.

#include "common/core/time.hpp"
#include "master/master_node.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class FaultHooks {
 public:
  virtual ~FaultHooks() = default;

  /// Returns the reading of a side's clock since the start. It must never decrease.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// Returns true if the side does not run in this tick. Robot and hand continue to move.
  virtual bool slave_skips_tick() { return false; }
  virtual bool master_skips_tick() { return false; }

  virtual void robot_reported(RobotState& /*told*/) {}      // robot state that the slave receives
  virtual void before_slave_step(SlaveInput& /*input*/) {}  // input of the slave's node, before its step
  /// Output of the node, before it reaches robot and link.
  virtual void after_slave_step(SlaveOutput& /*out*/) {}
  virtual void handle_reported(HandleState& /*told*/) {}  // device state that the master receives
  virtual void before_master_step(MasterInput& /*input*/) {}
  virtual void after_master_step(MasterOutput& /*out*/) {}
};

}  // namespace longreach
