#pragma once
// The master without I/O: connects mapping and rendering, decides about engagement, numbers the commands.
// step() is pure except for the state of the node: inputs are time, handle and messages; outputs are wrench
// and command. It allocates nothing and throws nothing.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "master/config/master_config.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// Requests of keys or RPC in this tick, besides the buttons of the device.
struct OperatorRequests {
  bool engage = false;  // begin a new engagement
  bool hold = false;    // stop following, resume with engage
  bool stop = false;    // latched stop of the robot
  std::optional<MotionMode> mode{};
  std::optional<double> scale{};  // 0.05 to 1; others are ignored and counted
  int scale_steps = 0;            // of 0.05
  bool clutch = false;            // state: while true the handle moves without the robot
  std::optional<bool> grip{};     // request to close or open the gripper
  bool turns_gripper = false;     // toggle the gripper
};

struct MasterInput {
  Time now{};
  HandleState handle{};
  std::span<const Received<StiffnessReport>> reports{};
  std::span<const Received<Telemetry>> telemetry{};
  OperatorRequests requests{};
  std::optional<Time> last_heard{};  // of any valid datagram
  std::uint32_t peer_restarts = 0;
  bool taken = false;               // another master has control of the robot: a state
  bool hand_stale = false;          // the data of the hand is too old
  std::optional<double> rtt_s{};    // of the link, once known
  bool may_send = true;             // within the budget of the link
  std::uint64_t overdue_ticks = 0;  // ticks so far that were late by more than one period, or missed
};

/// Data for display, status and log, once per tick.
struct MasterView {
  SafetyState state = SafetyState::kIdle;
  Reason cause{};
  SafetyState far_state = SafetyState::kIdle;
  std::uint32_t engagement = 0;
  /// safety.presence = HOLD, and no hand is on the handle: engagement is impossible
  bool hand_missing = false;
  bool engaging = false;      // an engagement waits for its answer
  // Seconds until the answer can arrive; none: no engagement is pending, or unknown.
  std::optional<double> answer_in_s{};
  std::optional<double> rtt_s{};        // median of the last half second
  std::optional<double> rtt_least_s{};  // minimum of that since the engagement: the accepted delay
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;
  bool clutched = false;
  std::optional<bool> grip{};  // requested, and not yet reported by the slave as done
  bool at_boundary = false;  // position mode: a handle is at its soft stop, time to relocate with the clutch
  Vector3 p_MH = Vector3::Zero();    // handle, m
  Vector3 goal_m = Vector3::Zero();  // goal minus anchor, W
  Vector3 goal_rad = Vector3::Zero();
  Pose forecast{};  // goal one one-way delay ahead, from the anchor, W: for a ghost in the display
  Wrench F_H_M{};   // rendered, on the hand
  Vector3 spring_force_n = Vector3::Zero();  // contribution of the contact spring
  bool in_contact = false;                   // as reported
  bool surface_known = false;
  double surface_m = 0.0;              // unit, into the surface, M
  Vector3 inward = Vector3::Zero();    // rendered stiffness, along the inward normal
  double stiffness_n_per_m = 0.0;      // maximum rendered stiffness: of the device, or as configured
  double stiffness_max_n_per_m = 0.0;  // of a contact by rotation
  Vector3 spring_moment_nm = Vector3::Zero();        // rendered stiffness, about the foremost axis
  double rotational_stiffness_nm_per_rad = 0.0;      // maximum rendered stiffness
  double rotational_stiffness_max_nm_per_rad = 0.0;  // change of the spring force by the last applied report
  double force_step_n = 0.0;       // of the spring force, by the last report that was applied
  double port_energy_j = 0.0;      // its minimum since the start of an engagement, over all engagements
  double port_energy_min_j = 0.0;  // least of it since an engagement began, of all of them
  double stored_energy_j = 0.0;
  double energy_drawdown_j = 0.0;  // largest fall of E_port - E_stored so far, J
  double tank_j = 0.0;
  bool force_clamped = false;
  bool stiffness_clamped = false;
  bool rotational_stiffness_clamped = false;
  bool damping_injected = false;
  std::uint64_t reports = 0;          // applied
  std::uint64_t rejected_values = 0;  // holds that ended automatically within resume_s
  std::uint64_t false_holds = 0;      // holds that ended by themselves within resume_s
  Telemetry far{};                    // newest telemetry
  bool far_known = false;
  // no datagram for silence_s
  bool silent = false;          // the hold ends automatically when its cause is over
  bool resumes = false;         // `cause` is that of the slave
  bool cause_is_far = false;    // why the last requested engagement is not granted
  Reason refusal{};             // why the engagement that was asked for last is not granted
  bool refusal_is_far = false;  // number of holds so far: Engaged was left
  std::uint64_t holds = 0;      // cause of the last hold
  Reason last_hold{};           // since the newest telemetry arrived
  double far_age_s = 0.0;       // longest silence during the present or last hold
  double hold_silence_s = 0.0;  // longest silence of the hold that is, or of the last one

  /// Closed, or asked to close.
  [[nodiscard]] bool gripper_closed() const { return grip.value_or(far.gripper.closed); }
};

struct MasterOutput {
  Wrench F_H_M{};                          // wrench on the hand
  std::optional<MotionCommand> command{};  // to send now
  std::uint64_t sequence = 0;              // its number
};

class MasterNode {
 public:
  explicit MasterNode(const MasterConfig& config);
  ~MasterNode();

  MasterOutput step(const MasterInput& input);

  /// Takes effect at the next step. Fields that may only change at start are ignored.
  void configure(const MasterConfig& config);

  [[nodiscard]] const MasterView& view() const;
  /// True while fields that may not change while engaged must not change.
  [[nodiscard]] bool engaged() const;
  /// Whether a tick now comes later than safety.gap_s after the one before: what came meanwhile is too old.
  [[nodiscard]] bool stalled(Time now) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
