#pragma once
// The loop of the master with real sockets, a device and an operator. One tick receives datagrams, reads the
// handle, steps the node, renders the wrench and sends a command. It runs only in the loop thread. Other
// threads communicate with it through the mailbox, the hand and the snapshots, which never block it.

#include <variant>

#include "common/rpc/side_shell.hpp"
#include "master/drivers/device_adapter.hpp"
#include "master/input/hand_brace.hpp"
#include "master/input/hand_level.hpp"
#include "master/input/remote_hand.hpp"
#include "master/recording/master_record_buffer.hpp"
#include "master/side/master_side.hpp"
#include "master/simulation/scripted_operator.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {

struct MasterSnapshot {
  SideFigures side{};
  MasterView view{};
  ScriptPhase phase = ScriptPhase::kWaiting;  // phase of the script, if the operator is a script
  bool hand_outside = false;                  // a remote client holds the handle
  AdapterFigures adapter{};
  /// The keyboard or pad is not available, or the handle has not reached its target since the input became
  /// available.
  bool hand_lost = false;
  HandBegin hand_begin{};
};

struct MasterChange : SideChange<MasterConfig> {
  bool script = false;  // the configuration of the script has changed, so it restarts
};
/// Another master has control of the robot, so the slave no longer sends datagrams to this master.
struct MasterPreempted {};

struct MasterParts {
  using Config = MasterConfig;
  using Message = proto::MasterConfig;
  using Side = MasterSide;
  using Adapter = DeviceAdapter;
  using Snapshot = MasterSnapshot;
  using RecordBuffer = MasterRecordBuffer;
  using Change = MasterChange;
  using Command = std::variant<OperatorRequests, MasterChange, ImpairmentConfig, Session, MasterPreempted,
                               RecordingChange<MasterRecordBuffer>>;
  static constexpr const char* kSide = "master";
  static constexpr RpcRole kRole = RpcRole::kMaster;
  static constexpr const char* kDevice = "haptic device";
  static const AdapterConfig& adapter_of(const MasterConfig& config) { return config.device_adapter; }
};
using MasterCommand = MasterParts::Command;

class MasterShell : public SideShell<MasterParts> {
 public:
  /// Throws AddressError for an invalid address, or std::runtime_error if the socket cannot be opened. `seed`
  /// initializes the random numbers of the simulated link impairment. `reduced`: bits of Protection that do not act
  /// outside the node.
  MasterShell(const MasterConfig& config, std::uint64_t seed, std::uint32_t reduced = 0);

  /// Runs one tick at `now`.
  void tick(Time now, const LoopFigures& loop);

  /// Written only by the thread that polls keyboard, gamepad or SpaceMouse.
  LatestValue<HandLevel>& hand() { return hand_; }
  /// Target from a remote client; written by one thread at a time.
  LatestValue<RemoteAim>& remote_aim() { return remote_aim_; }

 private:
  LoopAnswer obey(const MasterCommand& command, Time now, OperatorRequests& requests);
  HandTarget operate(Time now, const HandleState& handle, OperatorRequests& requests);
  void restart_script();
  void begin_hand(const HandleState& handle);
  void brace(HandTarget& target);
  HandTarget hold(const HandLevel& level);

  MasterConfig config_;
  SimulatedDevices devices_;  // used if no adapter is configured
  HapticDevice& device_;
  ScriptedOperator script_;
  Grip script_grip_;
  bool script_displaced_ = false;  // another hand has moved the handle since the last tick of the script
  Vector3 script_from_m_ = Vector3::Zero();  // where the script began then
  Vector3 held_m_ = Vector3::Zero();  // position of the hand that keyboard, gamepad or SpaceMouse controls
  Vector3 held_rad_ = Vector3::Zero();
  bool lost_ = false;        // see MasterSnapshot::hand_lost
  bool hand_stale_ = false;  // the input of the hand is too old in this tick
  RemoteHand remote_;
  HandBegin begin_{};
  HandBrace brace_m_{5e-4}, brace_rad_{5e-3};
  std::uint64_t holder_ = 0;      // remote client that holds the handle; 0: the configured operator
  std::uint32_t engagement_ = 0;  // engagement in the last tick
  LatestValue<HandLevel> hand_;
  LatestValue<RemoteAim> remote_aim_;
};

}  // namespace longreach
