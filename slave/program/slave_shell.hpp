#pragma once
// The loop of the slave with real sockets and a robot. One tick receives datagrams, steps the node, moves the
// robot and sends datagrams. It runs only in the thread of the loop. Other threads communicate with it
// through the mailbox, the stop level and snapshots, which never block the loop.

#include <variant>

#include "common/rpc/side_shell.hpp"
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

struct SlaveParts {
  using Config = SlaveConfig;
  using Message = proto::SlaveConfig;
  using Side = SlaveSide;
  using Adapter = RobotAdapter;
  using Snapshot = SlaveSnapshot;
  using RecordBuffer = SlaveRecordBuffer;
  using Change = SideChange<SlaveConfig>;
  using Command =
      std::variant<Change, ImpairmentConfig, SlaveLease, SlaveReturn, RecordingChange<SlaveRecordBuffer>>;
  static constexpr const char* kSide = "slave";
  static constexpr RpcRole kRole = RpcRole::kSlave;
  static constexpr const char* kDevice = "robot";
  static const AdapterConfig& adapter_of(const SlaveConfig& config) { return config.robot_adapter; }
};
using SlaveCommand = SlaveParts::Command;

class SlaveShell : public SideShell<SlaveParts> {
 public:
  /// Throws AddressError, or std::runtime_error if the socket cannot be opened. `seed` is used for the random
  /// numbers of the artificial impairment and of the simulated arm. `reduced`: bits of Protection that do not act
  /// outside the node.
  SlaveShell(const SlaveConfig& config, std::uint64_t seed, std::uint32_t reduced = 0);

  void tick(Time now, const LoopFigures& loop);

 private:
  LoopAnswer obey(const SlaveCommand& command, Time now);
  [[nodiscard]] bool occupied(Time now) const;

  SimulatedArm arm_;  // used as the robot if there is no adapter
  Robot& robot_;
};

}  // namespace longreach
