#pragma once
// The slave without I/O: playout, limits, inverse kinematics, contact detection and identification, and the
// autonomous safety state machine. step() is pure except for the state of the node; it allocates nothing and
// throws nothing.

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
  std::optional<Time> last_heard{};      // of any valid datagram
  std::uint32_t peer_session_count = 0;  // sessions of the master seen so far
  bool taken = false;                    // the newest of them took control from another master
  bool stop = false;                     // requested by RPC on this side
  double send_hz = 200.0;                // of the master, as reported when it opened the session
  std::uint64_t rejected = 0;            // datagrams dropped so far, for telemetry
  std::uint64_t late_ticks = 0;          // likewise
  std::uint64_t overdue_ticks = 0;       // ticks so far that were late by more than one period, or missed
  double up_loss = 0.0;                  // link statistics, for telemetry
  double up_jitter_s = 0.0;
  bool may_send = true;  // within the budget of the link
};

/// Data for status, log and laboratory, once per tick.
struct SlaveView {
  SafetyState state = SafetyState::kIdle;
  Reason cause{};
  std::uint32_t engagement = 0;
  Pose X_WE{};         // measured
  Pose X_WE_anchor{};  // of this engagement
  Pose X_WE_goal{};    // requested, before limits
  Wrench F_E_W{};      // measured
  bool in_contact = false;
  ContactEstimate estimate{};  // present estimate
  double reported_stiffness_n_per_m = 0.0;
  ContactEstimate turn_estimate{};  // of a contact by rotation: m are rad, N are N m
  double reported_stiffness_nm_per_rad = 0.0;
  Vector3 reported_at_m = Vector3::Zero();  // position, in W, that the reported stiffness belongs to
  double touch_sequence = 0.0;
  std::uint32_t touch = 0;
  double played_sequence = 0.0;
  double playout_delay_s = 0.0;
  Clamps clamps{};  // in this tick
  GripperState gripper{};
  SensorZero sensor_zero{};
  bool robot_seen = false;    // it has worked once
  Reason unready{};           // why no engagement could start with it or its sensor
  std::uint32_t refused = 0;  // engagement that is requested but not granted, and the reason; 0: none
  Reason refusal{};
  std::uint64_t limit_violations = 0;  // ticks in which a limit was exceeded despite the limiters
  LimitViolations violations_by_limit{};
  std::uint64_t false_holds = 0;      // holds by silence that ended automatically within resume_s
  std::uint64_t rejected_values = 0;  // commands with an impossible value
  std::uint64_t ik_failures = 0;      // ticks without a solution to tolerance
};

struct SlaveOutput {
  std::optional<JointVector> joint_setpoint_rad{};  // none: the robot is not commanded and holds itself
  std::optional<bool> grip{};                       // gripper closed or open; none: unchanged
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

  /// Takes effect at the next step. Fields that can only change at start are ignored.
  void configure(const SlaveConfig& config);

  [[nodiscard]] const SlaveView& view() const;
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` is later than the gap timer after the previous one: data that arrived
  /// meanwhile is too old.
  [[nodiscard]] bool stalled(Time now, double send_hz) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
