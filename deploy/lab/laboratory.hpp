#pragma once
// Both nodes, the link between them, robot and device, in one process and in virtual time. Nodes, ports,
// codecs and impairments are those of the programs; only channel, clock and device are simulated. A run is
// identified by (commit, config, seed); the same three give the same bytes.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "deploy/lab/fault_hooks.hpp"
#include "master/master_node.hpp"
#include "master/simulation/scripted_operator.hpp"
#include "master/simulation/simulated_devices.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

class LabRecording;

/// Statistics of the stiffness reports of the slave.
struct HapticReturn {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;  // without header and tag
};

class Laboratory {
 public:
  /// The configurations must be complete, with files resolved and the link profile in the impairments. Throws
  /// std::invalid_argument for a comparison law, which has a separate bench.
  Laboratory(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed);

  ~Laboratory();

  /// One tick of both sides.
  void step();

  [[nodiscard]] double now_s() const { return to_seconds(elapsed_); }
  [[nodiscard]] double period_s() const { return to_seconds(period_); }
  [[nodiscard]] const MasterView& master() const { return master_node_.view(); }
  [[nodiscard]] const SlaveView& slave() const { return slave_node_.view(); }
  [[nodiscard]] const SimulatedArm& arm() const { return arm_; }
  [[nodiscard]] SimulatedArm& arm() { return arm_; }
  [[nodiscard]] const SimulatedDevices& devices() const { return devices_; }
  [[nodiscard]] const ScriptedOperator& script() const { return script_; }
  [[nodiscard]] const MasterPort& master_port() const { return master_port_; }
  [[nodiscard]] const SlavePort& slave_port() const { return slave_port_; }
  /// Sets the impairment of the data that a side receives, from now on.
  void impair_slave(const ImpairmentConfig& c) { slave_port_.impairment().configure(c, slave_now()); }
  void impair_master(const ImpairmentConfig& c) { master_port_.impairment().configure(c, master_now()); }
  /// Datagrams that arrived at both sides.
  [[nodiscard]] std::uint64_t arrived() {
    return slave_port_.impairment().counts().out + master_port_.impairment().counts().out;
  }
  /// Starts another session at the given side.
  void hand_slave(const Session& session) { slave_port_.follow(session); }
  void hand_master(const Session& session) { master_port_.follow(session); }
  void configure_slave(const SlaveConfig& config) { slave_node_.configure(config); }
  void configure_master(const MasterConfig& config) { master_node_.configure(config); }
  [[nodiscard]] LinkFigures link() const { return master_port_.endpoint().monitor().figures(master_now()); }
  /// Link statistics of the direction from the master, as measured by the slave.
  [[nodiscard]] LinkFigures far_link() const { return slave_port_.endpoint().monitor().figures(slave_now()); }
  /// The last setpoint of the slave for the arm; none: it was not commanded.
  [[nodiscard]] const std::optional<JointVector>& setpoint_rad() const { return setpoint_rad_; }
  [[nodiscard]] const HapticReturn& haptic_return() const { return haptic_return_; }
  /// Position that the presently rendered stiffness belongs to, in W; zero before the first.
  [[nodiscard]] const Vector3& rendered_at_m() const { return rendered_at_m_; }
  /// Sets the target of the hand from now on, instead of the script.
  void drive(const HandTarget& target) { driven_ = target; }
  /// Requests for the next tick, in addition to those of the script.
  OperatorRequests& requests() { return requests_; }
  /// The operator releases the handles, permanently unless the hand returns.
  void let_go(bool away = true) { let_go_ = away; }
  /// Ends one side, like a killed program; robot and devices continue.
  void kill_slave() { slave_lives_ = false; }
  void kill_master() { master_lives_ = false; }
  /// Stalls the loop of one side for this time, like a stopped program: received datagrams queue up in its
  /// socket, and the next tick is late. Robot, devices, hand and the other side continue.
  void freeze_slave(double seconds) { slave_thaws_ = elapsed_ + from_seconds(seconds); }
  void freeze_master(double seconds) { master_thaws_ = elapsed_ + from_seconds(seconds); }
  /// Must live as long as the laboratory steps.
  void set_fault_hooks(FaultHooks& fault_hooks) { fault_hooks_ = &fault_hooks; }
  /// Starts a recording of both sides into one file, before the first step. Throws RecordingError.
  void record(const std::filesystem::path& file);
  /// Ends the file. Throws RecordingError if it could not be written.
  void end_recording();
  /// Sets a hook on the channel: called after the tick of each side, may receive and send at both ends (a:
  /// master, b: slave).
  void intrude(std::function<void(MemoryChannelPair&)> intruder) { intruder_ = std::move(intruder); }
  /// For tests: called before the first step of every laboratory, in its thread, with its configuration.
  struct Begun {
    const MasterConfig& master;
    const SlaveConfig& slave;
    bool driven;  // by drive(): the script is not used
  };
  inline static std::function<void(const Begun&)> on_first_step{};
  /// Sets a hook that may change the state reported by the robot in each tick.
  void tamper(std::function<void(Time, RobotState&)> tamperer) { tamperer_ = std::move(tamperer); }

 private:
  [[nodiscard]] Time master_now() const {
    return Time{std::chrono::seconds(100)} + (fault_hooks_ ? fault_hooks_->master_clock(elapsed_) : elapsed_);
  }
  [[nodiscard]] Time slave_now() const {
    return Time{std::chrono::seconds(77777)} +
           (fault_hooks_ ? fault_hooks_->slave_clock(elapsed_) : elapsed_);
  }
  void step_slave();
  void step_master();

  Duration period_;
  double send_hz_;
  MasterConfig master_config_;
  SlaveConfig slave_config_;
  std::uint64_t seed_;
  Duration elapsed_{0};
  MemoryChannelPair channels_;
  Random random_;
  MasterPort master_port_;
  SlavePort slave_port_;
  SlaveNode slave_node_;
  MasterNode master_node_;
  SimulatedArm arm_;
  SimulatedDevices devices_;
  ScriptedOperator script_;
  std::optional<HandTarget> driven_{};
  OperatorRequests requests_{};
  std::optional<double> rtt_s_{};
  bool let_go_ = false;
  bool slave_lives_ = true, master_lives_ = true;
  Duration slave_thaws_{0}, master_thaws_{0};
  std::uint64_t slave_overdue_ = 0, master_overdue_ = 0;
  std::function<void(MemoryChannelPair&)> intruder_{};
  std::function<void(Time, RobotState&)> tamperer_{};
  FaultHooks* fault_hooks_ = nullptr;
  std::unique_ptr<LabRecording> recording_{};
  Ring<Vector3> report_places_{4096};  // of the last reports, by sequence
  std::uint64_t last_report_ = 0;
  std::optional<JointVector> setpoint_rad_{};
  HapticReturn haptic_return_{};
  Vector3 rendered_at_m_ = Vector3::Zero();
};

}  // namespace longreach
