#pragma once
// The slave with its link. A tick receives the datagrams, steps the node, moves the robot and sends what the node says. The
// poses of the bodies that the robot tracks serve for display alone and do not pass through the node.
// Program and laboratory run this tick; they differ in channel, clock and robot.

#include "common/loop/side_figures.hpp"
#include "common/wire/port.hpp"
#include "slave/robot/robot.hpp"
#include "slave/send_schedule.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

/// Reads and changes what passes between the node and its surroundings, for faults. Called in the thread of the loop.
class SlaveHook {
 public:
  virtual ~SlaveHook() = default;
  virtual void robot_reported(Time /*now*/, RobotState& /*reported*/) {
  }                                                         // robot state that the slave receives
  virtual void before_slave_step(SlaveInput& /*input*/) {}  // input of the slave node, before its step
  /// Output of the slave node, before it reaches the robot and the link.
  virtual void after_slave_step(SlaveOutput& /*out*/) {}
};

class SlaveSide {
 public:
  /// `channel` must outlive the side. `random` draws the artificial impairment.
  /// `observer`: how often the statistics of the link are renewed.
  SlaveSide(const SlaveConfig& config, Channel& channel, Random random,
            SideObserver observer = SideObserver());

  /// Runs one tick. `loop`: statistics of the loop so far. `stop`: a stop is requested on this side.
  void tick(Time now, Robot& robot, const LoopFigures& loop, bool stop, SlaveHook* hook = nullptr);

  /// Joins a session, whose master sends with `send_hz`. `taken`: it takes the robot from another master, which the next
  /// tick passes to the node.
  void follow(const Session& session, double send_hz, bool taken = false);
  /// Takes effect in the next tick.
  void configure(const SlaveConfig& config);

  [[nodiscard]] SlaveNode& node() { return node_; }
  [[nodiscard]] const SlaveNode& node() const { return node_; }
  [[nodiscard]] SlavePort& port() { return port_; }
  [[nodiscard]] const SlavePort& port() const { return port_; }
  // Of the last tick.
  [[nodiscard]] const SlaveInput& input() const { return input_; }
  [[nodiscard]] const SlaveOutput& output() const { return output_; }
  [[nodiscard]] const SideFigures& figures() const { return observer_.figures(); }
  [[nodiscard]] std::size_t report_bytes() const {
    return report_bytes_;
  }                                                          // size of the report's datagram; 0: none
  [[nodiscard]] double send_hz() const { return send_hz_; }  // rate of the master of this session

 private:
  void limit(double kbit_per_s);
  void send_bodies(Time now, const Robot& robot);

  SlavePort port_;
  SlaveNode node_;
  SideObserver observer_;
  double send_hz_ = 300.0;
  bool taken_ = false;
  SlaveInput input_{};
  SlaveOutput output_{};
  std::size_t report_bytes_ = 0;
  double budget_kbit_per_s_ = 0.0;  // 0: unlimited
  bool has_bodies_ = false;         // the robot has tracked bodies
  SendSchedule bodies_;
  std::uint64_t bodies_sequence_ = 0;
};

}  // namespace longreach
