#pragma once
// Runs both nodes, the link between them, the robot and the device in one process and in virtual time. The
// nodes, ports, codecs and impairments are those of the real programs; only the channel, the clock, the robot
// and the device are simulated. A run is determined by (commit, config, seed): the same combination gives the
// same bytes.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "deploy/lab/fault_hooks.hpp"
#include "master/simulation/scripted_operator.hpp"
#include "master/simulation/simulated_devices.hpp"
#include "slave/simulation/simulated_robot.hpp"

namespace longreach {

class LabRecording;

/// Statistics of the stiffness reports sent by the slave.
struct HapticReturn {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;  // without headers and authentication tags
};

class Laboratory {
 public:
  /// The configurations must be complete, with files resolved and the link profile copied to the impairments.
  /// If robot.mjcf is set, MuJoCo simulates the robot; otherwise a SimulatedArm in its scene. Throws
  /// std::invalid_argument for a comparison law, which has a separate test bench, and for a robot.mjcf that is unsuitable
  /// or that this program cannot simulate.
  Laboratory(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed);

  ~Laboratory();

  /// Runs one tick of both sides.
  void step();

  [[nodiscard]] double now_s() const { return to_seconds(elapsed_); }
  [[nodiscard]] double period_s() const { return to_seconds(period_); }
  [[nodiscard]] const MasterView& master() const { return master_.node().view(); }
  [[nodiscard]] const SlaveView& slave() const { return slave_.node().view(); }
  [[nodiscard]] const SimulatedRobot& arm() const { return *arm_; }
  [[nodiscard]] SimulatedRobot& arm() { return *arm_; }
  [[nodiscard]] const SimulatedDevices& devices() const { return devices_; }
  [[nodiscard]] const ScriptedOperator& script() const { return script_; }
  [[nodiscard]] const MasterPort& master_port() const { return master_.port(); }
  [[nodiscard]] const SlavePort& slave_port() const { return slave_.port(); }
  /// Sets the impairment of all datagrams that one side receives from now on.
  void impair_slave(const ImpairmentConfig& c) { slave_.port().impairment().configure(c, slave_now()); }
  void impair_master(const ImpairmentConfig& c) { master_.port().impairment().configure(c, master_now()); }
  /// Total number of datagrams that arrived at both sides.
  [[nodiscard]] std::uint64_t arrived() {
    return slave_.port().impairment().counts().out + master_.port().impairment().counts().out;
  }
  /// Switches one side to another session. `taken`: its master takes the robot from another one.
  void hand_slave(const Session& session, bool taken = false) { slave_.follow(session, send_hz_, taken); }
  void hand_master(const Session& session) { master_.follow(session); }
  /// Requests a stop on the slave's side in the next tick.
  void stop_slave() { stop_slave_ = true; }
  void configure_slave(const SlaveConfig& config) { slave_.configure(config); }
  void configure_master(const MasterConfig& config) { master_.configure(config); }
  [[nodiscard]] LinkFigures link() const { return master_.port().endpoint().monitor().figures(master_now()); }
  /// Statistics of the link from master to slave, as measured by the slave.
  [[nodiscard]] LinkFigures far_link() const {
    return slave_.port().endpoint().monitor().figures(slave_now());
  }
  /// The setpoint that the slave sent to the arm in the last tick; std::nullopt if it sent none.
  [[nodiscard]] const std::optional<JointVector>& setpoint_rad() const {
    return slave_.output().joint_setpoint_rad;
  }
  [[nodiscard]] const HapticReturn& haptic_return() const { return haptic_return_; }
  /// Position, in W, to which the currently rendered stiffness report applies; zero before the first report.
  [[nodiscard]] const Vector3& rendered_at_m() const { return rendered_at_m_; }
  /// Sets the target of the hand. From now on, it replaces the script.
  void drive(const HandTarget& target) { driven_ = target; }
  /// Requests for the next tick, in addition to those from the script.
  OperatorRequests& requests() { return requests_; }
  /// Makes the operator release the handles (`away`) or grasp them again.
  void let_go(bool away = true) { let_go_ = away; }
  /// Stops one side permanently, as if its program were killed. The robot and the devices continue.
  void kill_slave() { slave_lives_ = false; }
  void kill_master() { master_lives_ = false; }
  /// Stalls the loop of one side for this time, as if its program were suspended: received datagrams queue up
  /// in its socket, and the next tick is late. The robot, the devices, the hand and the other side continue.
  void freeze_slave(double seconds) { slave_thaws_ = elapsed_ + from_seconds(seconds); }
  void freeze_master(double seconds) { master_thaws_ = elapsed_ + from_seconds(seconds); }
  /// Installs fault hooks. They must outlive the last step.
  void set_fault_hooks(FaultHooks& fault_hooks) { fault_hooks_ = &fault_hooks; }
  /// Starts a recording of both sides in one file. Call it before the first step. Throws RecordingError.
  void record(const std::filesystem::path& file);
  /// Completes the file. Throws RecordingError if it could not be written.
  void end_recording();
  /// Hooks whose begins() is called for every laboratory, for tests; null: none.
  inline static FaultHooks* of_all = nullptr;

 private:
  [[nodiscard]] Time master_now() const {
    return Time{std::chrono::seconds(100)} + fault_hooks_->master_clock(elapsed_);
  }
  [[nodiscard]] Time slave_now() const {
    return Time{std::chrono::seconds(77777)} + fault_hooks_->slave_clock(elapsed_);
  }
  void step_slave();
  void step_master();
  HandTarget operate(const HandleState& handle, OperatorRequests& requests);
  void count_skipped(LoopFigures& loop, std::uint64_t& skipped) const;

  Duration period_;
  double send_hz_;
  MasterConfig master_config_;
  SlaveConfig slave_config_;
  std::uint64_t seed_;
  Duration elapsed_{0};
  MemoryChannelPair channels_;
  Random random_;
  MasterSide master_;
  SlaveSide slave_;
  std::unique_ptr<SimulatedRobot> arm_;
  SimulatedDevices devices_;
  ScriptedOperator script_;
  std::optional<HandTarget> driven_{};
  OperatorRequests requests_{};
  bool let_go_ = false;
  bool slave_lives_ = true, master_lives_ = true;
  Duration slave_thaws_{0}, master_thaws_{0};
  LoopFigures slave_loop_{}, master_loop_{};
  std::uint64_t slave_skipped_ = 0, master_skipped_ = 0;  // ticks since the last one
  bool stop_slave_ = false;
  FaultHooks no_hooks_;
  FaultHooks* fault_hooks_ = &no_hooks_;
  std::unique_ptr<LabRecording> recording_{};
  Ring<Vector3> report_places_{4096};  // positions of the latest reports, by sequence number
  std::uint64_t last_report_ = 0;
  HapticReturn haptic_return_{};
  Vector3 rendered_at_m_ = Vector3::Zero();
};

}  // namespace longreach
