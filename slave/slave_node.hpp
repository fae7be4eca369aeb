#pragma once
// The slave without I/O: playout, limits, inverse kinematics, contact detection and identification, and the
// safety machine that acts alone. step() is pure but for the node's own state; it allocates nothing and
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

namespace longreach {

struct SlaveInput {
  Time now{};
  RobotState robot{};
  std::span<const Received<MotionCommand>> commands{};
  std::optional<Time> last_heard{};      // of any valid datagram
  std::uint32_t peer_session_count = 0;  // sessions of the master seen so far
  bool taken = false;                    // the newest of them by taking the robot from another master
  bool stop = false;                     // asked for by RPC on this side
  double send_hz = 200.0;                // of the master, as it said when it opened the session
  std::uint64_t rejected = 0;            // datagrams dropped so far, for telemetry
  std::uint64_t late_ticks = 0;          // likewise
  std::uint64_t overdue_ticks = 0;       // that came late by over one period so far, or not at all
  double up_loss = 0.0;                  // link figures, for telemetry
  double up_jitter_s = 0.0;
  bool may_send = true;  // within the budget of the link
};

/// Everything that status, log and laboratory need to know, once a tick.
struct SlaveView {
  SafetyState state = SafetyState::kIdle;
  Reason cause{};
  std::uint32_t engagement = 0;
  Pose X_WE{};         // measured
  Pose X_WE_anchor{};  // of this engagement
  Pose X_WE_goal{};    // asked for, before limits
  Wrench F_E_W{};      // measured
  bool in_contact = false;
  ContactEstimate estimate{};  // as it is now
  double reported_stiffness_n_per_m = 0.0;
  ContactEstimate turn_estimate{};  // of a contact by rotation: m are rad, N are N m
  double reported_stiffness_nm_per_rad = 0.0;
  Vector3 reported_at_m = Vector3::Zero();  // place, in W, that the reported stiffness belongs to
  double touch_sequence = 0.0;
  std::uint32_t touch = 0;
  double played_sequence = 0.0;
  double playout_delay_s = 0.0;
  Clamps clamps{};  // in this tick
  GripperState gripper{};
  bool robot_seen = false;    // it has worked once
  Reason unready{};           // why no engagement could begin with it or its sensor
  std::uint32_t refused = 0;  // engagement that is asked for and not granted, and why; 0: none
  Reason refusal{};
  std::uint64_t limit_violations = 0;  // ticks in which a limit was exceeded in spite of the clamps
  LimitViolations violations_by_limit{};
  std::uint64_t false_holds = 0;      // holds by silence that ended by themselves within resume_s
  std::uint64_t rejected_values = 0;  // commands with an impossible value
  std::uint64_t ik_failures = 0;      // ticks without a solution to tolerance
};

struct SlaveOutput {
  std::optional<JointVector> joint_setpoint_rad{};  // none: nobody commands the robot, it rests by itself
  std::optional<bool> grip{};                       // gripper closed or open; none: as it is
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

  /// Takes effect at the next step. Fields that may only change at start are ignored.
  void configure(const SlaveConfig& config);

  [[nodiscard]] const SlaveView& view() const;
  [[nodiscard]] bool engaged() const;
  /// Whether a tick now comes later than the gap timer after the one before: what came meanwhile is too old.
  [[nodiscard]] bool stalled(Time now, double send_hz) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
