#pragma once
// The master's loop with real sockets, a device and an operator: one tick receives, reads the handle, steps
// the node, renders the wrench, sends. Runs in the loop's thread alone; other threads reach it through the
// mailbox, the hand and the snapshots, which make it wait for nothing.

#include <variant>

#include "common/loop/latest_value.hpp"
#include "common/loop/mailbox.hpp"
#include "common/net/udp_channel.hpp"
#include "common/net/unix_channel.hpp"
#include "common/rpc/config_change.hpp"
#include "common/rpc/side_figures.hpp"
#include "common/wire/port.hpp"
#include "master/drivers/device_adapter.hpp"
#include "master/input/hand_level.hpp"
#include "master/input/remote_hand.hpp"
#include "master/master_node.hpp"
#include "master/recording/master_record_buffer.hpp"
#include "master/simulation/scripted_operator.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {

struct MasterSnapshot {
  SideFigures side{};
  MasterView view{};
  ScriptPhase phase = ScriptPhase::kWaiting;  // of the script, when it is the operator
  bool hand_outside = false;                  // a hand from outside holds the handle
  AdapterFigures adapter{};
  bool hand_lost = false;  // keyboard or pad is not there, or the handle is not yet where it wants it
};

struct MasterChange {
  MasterConfig config{};
  bool only_disengaged = false;  // a field changes that must not while engaged
  bool impairment = false;       // config.link.impairment has changed
  bool script = false;           // what the script acts on has changed: it begins anew
  std::uint32_t number = 0;      // of the configuration, for a recording
};
/// What is written down from now on; none: nothing. The loop no longer uses the one before.
struct MasterRecordingChange {
  MasterRecordBuffer* record_buffer = nullptr;
};
/// Another master has the robot now: that is why the slave is silent.
struct MasterPreempted {};
using MasterCommand = std::variant<OperatorRequests, MasterChange, ImpairmentConfig, Session, MasterPreempted,
                                   MasterRecordingChange>;

class MasterShell {
 public:
  /// Throws AddressError or std::runtime_error when the socket cannot be had. `seed`: of the artificial
  /// impairment.
  MasterShell(const MasterConfig& config, std::uint64_t seed);

  /// Waits until the device's adapter answers, at most 2 s, and not when there is none. Before the first
  /// tick.
  void wait_for_device();
  void tick(Time now, const LoopFigures& loop);

  /// Before the first tick; later by MasterRecordingChange.
  void record(MasterRecordBuffer* record_buffer) { record_buffer_ = record_buffer; }

  /// Loop thread only: the picture of the last tick.
  [[nodiscard]] const MasterSnapshot& last() const { return snapshot_; }

  Mailbox<MasterCommand, LoopAnswer>& mailbox() { return mailbox_; }
  StopLevel& stops() { return stops_; }
  LatestValue<MasterSnapshot>& snapshots() { return snapshots_; }
  /// Written by the thread that polls keyboard, gamepad or SpaceMouse.
  LatestValue<HandLevel>& hand() { return hand_; }
  /// Written by one thread at a time, for a hand from outside.
  LatestValue<RemoteAim>& remote_aim() { return remote_aim_; }
  [[nodiscard]] std::string address() const { return channel_.local_address(); }

 private:
  LoopAnswer obey(const MasterCommand& command, Time now, OperatorRequests& requests);
  HandTarget operate(Time now, const HandleState& handle, OperatorRequests& requests);
  HandTarget displaced(const HandTarget& target);
  HandTarget hold(const HandLevel& level, const HandleState& handle);
  void write_down(const MasterInput& in, const MasterOutput& out);

  MasterConfig config_;
  UdpChannel channel_;
  MasterPort port_;
  SimulatedDevices devices_;  // are moved while there is no adapter
  std::unique_ptr<UnixChannel> adapter_channel_;
  std::optional<DeviceAdapter> adapter_;
  HapticDevice& device_;
  ScriptedOperator script_;
  Grip script_grip_;
  MasterNode node_;
  Vector3 held_m_ = Vector3::Zero();  // where the hand at keyboard, gamepad or SpaceMouse is
  Vector3 held_rad_ = Vector3::Zero();
  bool lost_ = false;        // as MasterSnapshot::hand_lost
  bool hand_stale_ = false;  // in this tick
  RemoteHand remote_;
  SideObserver observer_;
  bool preempted_ = false;                       // until the next session
  MasterRecordBuffer* record_buffer_ = nullptr;  // none: nothing is recorded
  std::uint64_t ticks_ = 0;                      // steps of the node
  std::uint32_t config_number_ = 0;              // of what it was configured with
  MasterSnapshot snapshot_{};
  StopLevel stops_;
  Mailbox<MasterCommand, LoopAnswer> mailbox_;
  LatestValue<MasterSnapshot> snapshots_;
  LatestValue<HandLevel> hand_;
  LatestValue<RemoteAim> remote_aim_;
};

}  // namespace longreach
