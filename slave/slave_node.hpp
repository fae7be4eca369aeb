#pragma once
// The slave without I/O: playout, limits, inverse kinematics, contact detection and identification, and its
// own safety state machine. step() has no side effects except on the state of the node; it does not allocate
// memory or throw exceptions.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "common/link/envelope.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "slave/command/limit_violations.hpp"
#include "slave/config/slave_config.hpp"
#include "slave/robot/robot.hpp"
#include "slave/sensing/bias_tracker.hpp"

namespace longreach {

struct SlaveInput {
  Time now{};
  RobotState robot{};
  std::span<const Received<MotionCommand>> commands{};
  std::optional<Time> last_heard{};      // arrival of the last valid datagram
  std::uint32_t peer_session_count = 0;  // number of master sessions so far
  /// True if the newest session took control from another master.
  bool taken = false;
  bool stop = false;  // a stop is requested by RPC on this side
  /// Send rate that the master reported when it opened the session.
  double send_hz = 200.0;
  std::uint64_t rejected = 0;    // datagrams dropped so far, for telemetry
  std::uint64_t late_ticks = 0;  // late ticks so far, for telemetry
  /// Number of ticks so far that were missed or late by more than one period.
  std::uint64_t overdue_ticks = 0;
  double up_loss = 0.0;  // link statistics, for telemetry
  double up_jitter_s = 0.0;
  bool may_send = true;  // the budget of the link permits a datagram
};

/// Values for status, log and laboratory, updated in every tick.
struct SlaveView {
  SafetyState state = SafetyState::kIdle;
  Reason cause{};
  std::uint32_t engagement = 0;
  Pose X_WE{};         // measured pose of the tool
  Pose X_WE_anchor{};  // anchor of this engagement
  Pose X_WE_goal{};    // requested pose, before limits
  Wrench F_E_W{};      // measured wrench on the tool
  bool in_contact = false;
  ContactEstimate estimate{};  // current estimate
  double reported_stiffness_n_per_m = 0.0;
  ContactEstimate turn_estimate{};  // rotational contact: N and m stand for N m and rad
  double reported_stiffness_nm_per_rad = 0.0;
  /// Position in W to which the reported stiffness applies.
  Vector3 reported_at_m = Vector3::Zero();
  double touch_sequence = 0.0;
  std::uint32_t touch = 0;
  double played_sequence = 0.0;
  double playout_delay_s = 0.0;
  Clamps clamps{};  // limits that were active in this tick
  GripperState gripper{};
  SensorZero sensor_zero{};
  std::uint32_t reduced = 0;  // bits of Protection (common/link/protection.hpp): protections that do not act
  double approach_m_per_s = 0.0;  // speed limit in unknown space; 0: the speed is not limited by it
  bool robot_seen = false;        // the robot was ok at least once
  /// Reason, related to the robot or its sensor, why no engagement could start.
  Reason unready{};
  /// Number of the engagement that is requested but not granted (0: none), and the reason.
  std::uint32_t refused = 0;
  Reason refusal{};
  /// Number of the last engagement that was refused for good (0: none), and the reason.
  std::uint32_t ended = 0;
  Reason ended_because{};
  /// Number of ticks in which a limit was exceeded despite the limiters.
  std::uint64_t limit_violations = 0;
  LimitViolations violations_by_limit{};
  /// Number of holds that were caused by missing datagrams and ended automatically within resume_s.
  std::uint64_t false_holds = 0;
  std::uint64_t rejected_values = 0;  // number of commands with an impossible value
  std::uint64_t ik_failures = 0;      // number of ticks without an exact inverse solution
};

struct SlaveOutput {
  /// If unset, the robot is not commanded and holds its position by itself.
  std::optional<JointVector> joint_setpoint_rad{};
  /// True closes the gripper, and false opens it; if unset, the gripper does not change.
  std::optional<bool> grip{};
  std::optional<StiffnessReport> report{};
  std::uint64_t report_sequence = 0;
  std::optional<Telemetry> telemetry{};
  std::uint64_t telemetry_sequence = 0;
};

class SlaveNode {
 public:
  explicit SlaveNode(const SlaveConfig& config);
  ~SlaveNode();

  SlaveOutput step(const SlaveInput& input);

  /// Changes the configuration from the next step on. Fields that can only be set at startup are ignored.
  void configure(const SlaveConfig& config);

  [[nodiscard]] const SlaveView& view() const;
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` follows the previous one by more than the gap timer. Datagrams that
  /// arrived in between are then too old.
  [[nodiscard]] bool stalled(Time now, double send_hz) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
