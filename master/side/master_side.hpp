#pragma once
// The master with its link. A tick receives the datagrams, reads the handle, lets the operator answer to it, steps the node,
// writes the wrench and sends the command. Program and laboratory run this tick; they differ in channel, clock,
// device and operator.

#include "common/loop/side_figures.hpp"
#include "common/wire/port.hpp"
#include "master/devices/haptic_device.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// Reads and changes what passes between the node and its surroundings, for faults. Called in the thread of the loop.
class MasterHook {
 public:
  virtual ~MasterHook() = default;
  virtual void handle_reported(HandleState& /*reported*/) {}  // device state that the master receives
  virtual void before_master_step(MasterInput& /*input*/) {}
  virtual void after_master_step(MasterOutput& /*out*/) {}
};

/// What the operator asks in a tick.
struct OperatorSays {
  OperatorRequests requests{};
  bool hand_stale = false;  // the input from the operator's hand is too old
  bool lost = false;        // the simulated handle has no hand and counts as failed
};

class MasterSide {
 public:
  /// `channel` must outlive the side. `random` draws the artificial impairment.
  /// `observer`: how often the statistics of the link are renewed.
  MasterSide(const MasterConfig& config, Channel& channel, Random random,
             SideObserver observer = SideObserver());

  /// The first half of a tick: receives datagrams and returns the state of the handle.
  const HandleState& read(Time now, HapticDevice& device, MasterHook* hook = nullptr);
  /// The second half of the tick of the last read(). `loop`: statistics of the loop so far.
  void step(HapticDevice& device, const LoopFigures& loop, const OperatorSays& operator_says,
            MasterHook* hook = nullptr);

  void follow(const Session& session);
  /// Another master has taken the robot, until the next session.
  void preempt() { preempted_ = true; }
  /// Takes effect in the next tick.
  void configure(const MasterConfig& config);

  [[nodiscard]] MasterNode& node() { return node_; }
  [[nodiscard]] const MasterNode& node() const { return node_; }
  [[nodiscard]] MasterPort& port() { return port_; }
  [[nodiscard]] const MasterPort& port() const { return port_; }
  // Of the last tick.
  [[nodiscard]] const MasterInput& input() const { return input_; }
  [[nodiscard]] const MasterOutput& output() const { return output_; }
  [[nodiscard]] const SideFigures& figures() const { return observer_.figures(); }

 private:
  MasterPort port_;
  MasterNode node_;
  SideObserver observer_;
  bool preempted_ = false;
  MasterInput input_{};
  MasterOutput output_{};
};

}  // namespace longreach
