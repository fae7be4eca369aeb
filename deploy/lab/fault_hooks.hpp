#pragma once
// Hooks between the nodes of a laboratory and their environment. They can observe and modify all data. Except
// for the clocks, each function is called once per tick. The default implementations change nothing.

#include <functional>
#include <utility>

#include "common/wire/memory_channel.hpp"
#include "master/side/master_side.hpp"
#include "slave/side/slave_side.hpp"

namespace longreach {

class FaultHooks : public SlaveHook, public MasterHook {
 public:
  /// Called before the first step of a laboratory, with its configuration. `driven`: the hand does not follow the script.
  virtual void begins(const MasterConfig& /*master*/, const SlaveConfig& /*slave*/, bool /*driven*/) {}
  /// Returns the time since the start according to the clock of one side. It must never decrease.
  virtual Duration slave_clock(Duration elapsed) { return elapsed; }
  virtual Duration master_clock(Duration elapsed) { return elapsed; }
  /// Returns true if the side skips this tick. The robot and the hand continue to move.
  virtual bool slave_skips_tick() { return false; }
  virtual bool master_skips_tick() { return false; }
  /// Called after the tick of each side, first the slave's; may receive and send at either end (a: master, b: slave).
  virtual void on_wire(MemoryChannelPair& /*wire*/) {}
};

/// Calls a function with the state that the robot reports.
class OnRobot : public FaultHooks {
 public:
  explicit OnRobot(std::function<void(Time, RobotState&)> call) : call_(std::move(call)) {}
  void robot_reported(Time now, RobotState& reported) override { call_(now, reported); }

 private:
  std::function<void(Time, RobotState&)> call_;
};

/// Calls a function with the channel.
class OnWire : public FaultHooks {
 public:
  explicit OnWire(std::function<void(MemoryChannelPair&)> call) : call_(std::move(call)) {}
  void on_wire(MemoryChannelPair& wire) override { call_(wire); }

 private:
  std::function<void(MemoryChannelPair&)> call_;
};

}  // namespace longreach
