#pragma once
// The slave's loop with real sockets and a robot: one tick receives, steps the node, moves the robot, sends.
// Runs in the loop's thread alone; other threads reach it through mailbox, stops and snapshots, which make
// it wait for nothing.

#include <variant>

#include "common/loop/latest_value.hpp"
#include "common/loop/mailbox.hpp"
#include "common/net/udp_channel.hpp"
#include "common/net/unix_channel.hpp"
#include "common/rpc/config_change.hpp"
#include "common/rpc/side_figures.hpp"
#include "common/wire/port.hpp"
#include "slave/drivers/robot_adapter.hpp"
#include "slave/recording/slave_record_buffer.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

struct SlaveSnapshot {
  SideFigures side{};
  SlaveView view{};
  std::uint64_t rejected_setpoints = 0;
  bool watchdog_stopped = false;
  double send_hz = 300.0;  // of the master, as it said
  AdapterFigures adapter{};
};

struct SlaveChange {
  SlaveConfig config{};
  bool only_disengaged = false;  // a field changes that must not while engaged
  bool impairment = false;       // config.link.impairment has changed
  std::uint32_t number = 0;      // of the configuration, for a recording
};
/// What is written down from now on; none: nothing. The loop no longer uses the one before.
struct SlaveRecordingChange {
  SlaveRecordBuffer* record_buffer = nullptr;
};
/// A master asks for the robot. `take`: also while another one has it.
struct SlaveLease {
  Session session{};
  bool take = false;
  double send_hz = 300.0;
};
/// A master gives it back.
struct SlaveReturn {
  std::uint64_t session = 0;
};
using SlaveCommand =
    std::variant<SlaveChange, ImpairmentConfig, SlaveLease, SlaveReturn, SlaveRecordingChange>;

class SlaveShell {
 public:
  /// Throws AddressError or std::runtime_error when the socket cannot be had. `seed`: of the artificial
  /// impairment and of the simulated arm.
  SlaveShell(const SlaveConfig& config, std::uint64_t seed);

  /// Waits until the robot's adapter answers, at most 2 s, and not when there is none. Before the first tick.
  void wait_for_robot();
  void tick(Time now, const LoopFigures& loop);

  /// Before the first tick; later by SlaveRecordingChange.
  void record(SlaveRecordBuffer* record_buffer) { record_buffer_ = record_buffer; }

  Mailbox<SlaveCommand, LoopAnswer>& mailbox() { return mailbox_; }
  StopLevel& stops() { return stops_; }
  LatestValue<SlaveSnapshot>& snapshots() { return snapshots_; }
  [[nodiscard]] std::string address() const { return channel_.local_address(); }

 private:
  /// `taken`: whether another master has control of the robot from this tick on.
  LoopAnswer obey(const SlaveCommand& command, Time now, bool& taken);
  [[nodiscard]] bool occupied(Time now) const;
  void write_down(const SlaveInput& in, const SlaveOutput& out);

  UdpChannel channel_;
  SlavePort port_;
  SimulatedArm arm_;  // moves while there is no adapter
  std::unique_ptr<UnixChannel> adapter_channel_;
  std::optional<RobotAdapter> adapter_;
  Robot& robot_;
  SlaveNode node_;
  SideObserver observer_;
  SlaveRecordBuffer* record_buffer_ = nullptr;  // none: nothing is recorded
  std::uint64_t ticks_ = 0;                     // steps of the node
  std::uint32_t config_number_ = 0;             // of what it was configured with
  SlaveSnapshot snapshot_{};
  StopLevel stops_;
  Mailbox<SlaveCommand, LoopAnswer> mailbox_;
  LatestValue<SlaveSnapshot> snapshots_;
};

}  // namespace longreach
