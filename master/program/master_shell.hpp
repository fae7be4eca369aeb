#pragma once
// The loop of the master with real sockets, a device and an operator: one tick receives, reads the handle,
// steps the node, renders the wrench, sends. It runs only in the thread of the loop; other threads
// communicate with it by the mailbox, the hand and the snapshots, which never block it.

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
  ScriptPhase phase = ScriptPhase::kWaiting;  // of the script, if it is the operator
  bool hand_outside = false;                  // a remote hand holds the handle
  AdapterFigures adapter{};
  bool hand_lost = false;  // keyboard or pad is not available, or the handle has not yet reached its target
};

struct MasterChange {
  MasterConfig config{};
  bool only_disengaged = false;  // a field changes that cannot change while engaged
  bool impairment = false;       // config.link.impairment has changed
  bool script = false;           // the configuration of the script has changed: it restarts
  std::uint32_t number = 0;      // of the configuration, for a recording
};
/// Record buffer from now on; none: no recording. The loop no longer uses the previous one.
struct MasterRecordingChange {
  MasterRecordBuffer* record_buffer = nullptr;
};
/// Another master has control of the robot, which is why the slave is silent.
struct MasterPreempted {};
using MasterCommand = std::variant<OperatorRequests, MasterChange, ImpairmentConfig, Session, MasterPreempted,
                                   MasterRecordingChange>;

class MasterShell {
 public:
  /// Throws AddressError, or std::runtime_error if the socket cannot be opened. `seed`: of the artificial
  /// impairment.
  MasterShell(const MasterConfig& config, std::uint64_t seed);

  /// Waits until the adapter of the device answers, at most 2 s; returns at once if there is none. Call it
  /// before the first tick.
  void wait_for_device();
  void tick(Time now, const LoopFigures& loop);

  /// Call it before the first tick; later use MasterRecordingChange.
  void record(MasterRecordBuffer* record_buffer) { record_buffer_ = record_buffer; }

  /// Loop thread only: snapshot of the last tick.
  [[nodiscard]] const MasterSnapshot& last() const { return snapshot_; }

  Mailbox<MasterCommand, LoopAnswer>& mailbox() { return mailbox_; }
  StopLevel& stops() { return stops_; }
  LatestValue<MasterSnapshot>& snapshots() { return snapshots_; }
  /// Written by the thread that polls keyboard, gamepad or SpaceMouse.
  LatestValue<HandLevel>& hand() { return hand_; }
  /// Written by one thread at a time, for a remote hand.
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
  SimulatedDevices devices_;  // simulated while there is no adapter
  std::unique_ptr<UnixChannel> adapter_channel_;
  std::optional<DeviceAdapter> adapter_;
  HapticDevice& device_;
  ScriptedOperator script_;
  Grip script_grip_;
  MasterNode node_;
  Vector3 held_m_ = Vector3::Zero();  // position of the hand at keyboard, gamepad or SpaceMouse
  Vector3 held_rad_ = Vector3::Zero();
  bool lost_ = false;        // as MasterSnapshot::hand_lost
  bool hand_stale_ = false;  // in this tick
  RemoteHand remote_;
  SideObserver observer_;
  bool preempted_ = false;                       // until the next session
  MasterRecordBuffer* record_buffer_ = nullptr;  // none: no recording
  std::uint64_t ticks_ = 0;                      // steps of the node
  std::uint32_t config_number_ = 0;              // number of its configuration
  MasterSnapshot snapshot_{};
  StopLevel stops_;
  Mailbox<MasterCommand, LoopAnswer> mailbox_;
  LatestValue<MasterSnapshot> snapshots_;
  LatestValue<HandLevel> hand_;
  LatestValue<RemoteAim> remote_aim_;
};

}  // namespace longreach
