#pragma once
// The loop of the slave with real sockets and a robot. One tick receives datagrams, steps the node, moves the
// robot and sends datagrams. It runs only in the thread of the loop. Other threads communicate with it
// through the mailbox, the stop level and snapshots, which never block the loop.

#include <variant>

#include "common/loop/latest_value.hpp"
#include "common/loop/mailbox.hpp"
#include "common/net/udp_channel.hpp"
#include "common/net/unix_channel.hpp"
#include "common/rpc/config_change.hpp"
#include "slave/drivers/robot_adapter.hpp"
#include "slave/recording/slave_record_buffer.hpp"
#include "slave/side/slave_side.hpp"
#include "slave/simulation/simulated_arm.hpp"

namespace longreach {

struct SlaveSnapshot {
  SideFigures side{};
  SlaveView view{};
  std::uint64_t rejected_setpoints = 0;
  bool watchdog_stopped = false;
  double send_hz = 300.0;  // send rate reported by the master
  AdapterFigures adapter{};
};

struct SlaveChange {
  SlaveConfig config{};
  /// True if a field changed that must not change during an engagement.
  bool only_disengaged = false;
  bool impairment = false;   // config.link.impairment changed
  std::uint32_t number = 0;  // configuration number for a recording
};
/// Sets the record buffer; null: no recording. After the command has been processed, the loop no longer uses
/// the previous buffer.
struct SlaveRecordingChange {
  SlaveRecordBuffer* record_buffer = nullptr;
};
/// A master requests control of the robot. `take`: take control even if another master has it.
struct SlaveLease {
  Session session{};
  bool take = false;
  double send_hz = 300.0;
};
/// A master releases control of the robot.
struct SlaveReturn {
  std::uint64_t session = 0;
};
using SlaveCommand =
    std::variant<SlaveChange, ImpairmentConfig, SlaveLease, SlaveReturn, SlaveRecordingChange>;

class SlaveShell {
 public:
  /// Throws AddressError, or std::runtime_error if the socket cannot be opened. `seed` is used for the random
  /// numbers of the artificial impairment and of the simulated arm. `reduced`: bits of Protection that do not act
  /// outside the node.
  SlaveShell(const SlaveConfig& config, std::uint64_t seed, std::uint32_t reduced = 0);

  /// Waits at most 2 s for a reply from the robot adapter; returns at once if there is no adapter. Call this
  /// before the first tick.
  void wait_for_robot();
  void tick(Time now, const LoopFigures& loop);

  /// Sets the record buffer. Call this only before the first tick; later, use SlaveRecordingChange.
  void record(SlaveRecordBuffer* record_buffer) { record_buffer_ = record_buffer; }

  Mailbox<SlaveCommand, LoopAnswer>& mailbox() { return mailbox_; }
  StopLevel& stops() { return stops_; }
  LatestValue<SlaveSnapshot>& snapshots() { return snapshots_; }
  [[nodiscard]] std::string address() const { return channel_.local_address(); }

 private:
  LoopAnswer obey(const SlaveCommand& command, Time now);
  [[nodiscard]] bool occupied(Time now) const;
  void publish();
  void write_down();

  UdpChannel channel_;
  SimulatedArm arm_;  // used as the robot if there is no adapter
  std::unique_ptr<UnixChannel> adapter_channel_;
  std::optional<RobotAdapter> adapter_;
  Robot& robot_;
  SlaveSide side_;
  SlaveRecordBuffer* record_buffer_ = nullptr;  // null: no recording
  std::uint64_t ticks_ = 0;                     // number of steps of the node
  std::uint32_t config_number_ = 0;             // number of the node's configuration
  std::uint32_t reduced_;
  SlaveSnapshot snapshot_{};
  StopLevel stops_;
  Mailbox<SlaveCommand, LoopAnswer> mailbox_;
  LatestValue<SlaveSnapshot> snapshots_;
};

}  // namespace longreach
