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
  bool engaging = false;  // an engagement waits for its answer
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
  double surface_m = 0.0;              // registered surface along the inward normal, from handle home, m
  Vector3 inward = Vector3::Zero();    // unit, into the surface, M
  double stiffness_n_per_m = 0.0;      // rendered stiffness, along the inward normal
  double stiffness_max_n_per_m = 0.0;  // maximum rendered stiffness: of the device, or as configured
  Vector3 spring_moment_nm = Vector3::Zero();        // of a contact by rotation
  double rotational_stiffness_nm_per_rad = 0.0;      // rendered stiffness, about the foremost axis
  double rotational_stiffness_max_nm_per_rad = 0.0;  // maximum rendered stiffness
  double force_step_n = 0.0;                         // change of the spring force by the last applied report
  double port_energy_j = 0.0;      // net energy from the hand into the device, f[k-1] (x[k] - x[k-1])
  double port_energy_min_j = 0.0;  // its minimum since the start of an engagement, over all engagements
  double stored_energy_j = 0.0;
  double energy_drawdown_j = 0.0;  // maximum decrease of E_port - E_stored so far, J
  double tank_j = 0.0;
  bool force_clamped = false;
  bool stiffness_clamped = false;
  bool rotational_stiffness_clamped = false;
  bool damping_injected = false;
  std::uint64_t reports = 0;          // applied
  std::uint64_t rejected_values = 0;  // ignored: not finite, out of range
  std::uint64_t false_holds = 0;      // holds that ended automatically within resume_s
  Telemetry far{};                    // newest telemetry
  bool far_known = false;
  // For display only; a recording has them in its messages.
  bool silent = false;          // no datagram for silence_s
  bool resumes = false;         // the hold ends automatically when its cause is over
  bool cause_is_far = false;    // `cause` is that of the slave
  Reason refusal{};             // why the last requested engagement is not granted
  bool refusal_is_far = false;  // likewise
  std::uint64_t holds = 0;      // number of holds so far: Engaged was left
  Reason last_hold{};           // cause of the last hold
  double far_age_s = 0.0;       // since the newest telemetry arrived
  double hold_silence_s = 0.0;  // longest silence during the present or last hold

  /// Closed, or requested to close.
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

  /// Takes effect at the next step. Fields that can only change at start are ignored.
  void configure(const MasterConfig& config);

  [[nodiscard]] const MasterView& view() const;
  /// True while fields that cannot change while engaged must not change.
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` is later than safety.gap_s after the previous one: data that arrived
  /// meanwhile is too old.
  [[nodiscard]] bool stalled(Time now) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
