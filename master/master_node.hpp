#pragma once
// The master without I/O. The node connects mapping and rendering, controls engagements and numbers the commands.
// Its inputs are the time, the state of the handle and the received messages; its outputs are the wrench and the
// command. step() has no side effects except on the state of the node, and neither allocates nor throws.

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

/// Requests from the keyboard or RPC clients in this tick, in addition to the buttons of the device.
struct OperatorRequests {
  bool engage = false;  // start a new engagement
  bool hold = false;    // the robot stops following; `engage` resumes motion
  bool stop = false;    // latched stop of the robot; only `engage` clears it
  std::optional<MotionMode> mode{};
  std::optional<double> scale{};  // 0.05 to 1; other values are ignored and counted
  int scale_steps = 0;            // number of steps of 0.05 to add to the scale
  bool clutch = false;            // true while the handle moves without the robot
  std::optional<bool> grip{};     // true closes the gripper, false opens it
  bool turns_gripper = false;     // toggle the gripper
};

struct MasterInput {
  Time now{};
  HandleState handle{};
  std::span<const Received<StiffnessReport>> reports{};
  std::span<const Received<Telemetry>> telemetry{};
  OperatorRequests requests{};
  std::optional<Time> last_heard{};  // arrival of the last valid datagram of any type
  std::uint32_t peer_restarts = 0;
  bool taken = false;               // true while another master has control of the robot
  bool hand_stale = false;          // the input from the operator's hand is too old
  std::optional<double> rtt_s{};    // round-trip time of the link; none until it is known
  bool may_send = true;             // the bandwidth budget allows a datagram now
  std::uint64_t overdue_ticks = 0;  // total of ticks that were missed or late by more than one period
};

/// Data for display, status and log, updated once per tick.
struct MasterView {
  SafetyState state = SafetyState::kIdle;
  Reason cause{};
  SafetyState far_state = SafetyState::kIdle;
  std::uint32_t engagement = 0;
  /// safety.presence is HOLD and no hand is on the handle, so that no engagement is possible.
  bool hand_missing = false;
  bool engaging = false;  // an engagement is requested and the reply is pending
  /// Seconds until the reply to the pending request can arrive; none if no engagement is pending or the
  /// round-trip time is unknown.
  std::optional<double> answer_in_s{};
  std::optional<double> rtt_s{};        // median over the last half second
  std::optional<double> rtt_least_s{};  // minimum of rtt_s since the engagement: the accepted delay
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;
  bool clutched = false;
  std::optional<bool> grip{};  // requested gripper state (true: closed) that the slave has not confirmed yet
  // State of the gripper in the newest report.
  bool far_gripper_closed = false, far_load = false;
  double approach_m_per_s = 0.0;  // speed limit of the robot in unknown space, m/s; 0: not limited
  std::uint32_t reduced = 0;      // bits of Protection (common/link/protection.hpp) of this side
  bool at_boundary = false;  // position mode: a handle is at its soft stop; use the clutch to reposition it
  Vector3 p_MH = Vector3::Zero();    // handle from home, m, M
  Vector3 goal_m = Vector3::Zero();  // goal relative to the anchor, W
  Vector3 goal_rad = Vector3::Zero();
  /// Goal relative to the anchor, W, extrapolated by the one-way delay for the predictive overlay of the display.
  Pose forecast{};
  Wrench F_H_M{};  // rendered wrench on the hand
  /// Force on the hand from the contact spring with the largest force, M.
  Vector3 spring_force_n = Vector3::Zero();
  bool in_contact = false;  // as reported by the slave
  bool surface_known = false;
  double surface_m = 0.0;            // position of the registered surface along `inward`, relative to home, m
  Vector3 inward = Vector3::Zero();  // unit vector into the surface, M
  double stiffness_n_per_m = 0.0;    // rendered stiffness along the inward normal
  /// Maximum stiffness that can be rendered: the limit of the device or the configured limit.
  double stiffness_max_n_per_m = 0.0;
  /// Moment on the hand from the spring with the largest moment, M.
  Vector3 spring_moment_nm = Vector3::Zero();
  double rotational_stiffness_nm_per_rad = 0.0;  // rendered stiffness about the axis with the largest moment
  double rotational_stiffness_max_nm_per_rad = 0.0;  // maximum stiffness that can be rendered
  double force_step_n = 0.0;   // change of the spring force caused by the last applied report
  double port_energy_j = 0.0;  // net energy from the hand into the device
  /// Minimum, over all engagements, of the port energy since the start of the engagement.
  double port_energy_min_j = 0.0;
  double stored_energy_j = 0.0;
  double energy_drawdown_j = 0.0;  // maximum decrease of port energy minus stored energy so far
  double tank_j = 0.0;
  bool force_clamped = false;
  bool stiffness_clamped = false;
  bool rotational_stiffness_clamped = false;
  bool damping_injected = false;
  std::uint64_t reports = 0;          // number of applied reports
  std::uint64_t rejected_values = 0;  // number of ignored values: not finite or out of range
  std::uint64_t false_holds = 0;      // holds that ended automatically within resume_s
  Telemetry far{};                    // newest telemetry
  bool far_known = false;
  // For display only; a recording contains these values in its messages.
  bool silent = false;          // no datagram for longer than silence_s
  bool resumes = false;         // the hold ends automatically when its cause disappears
  bool cause_is_far = false;    // `cause` was reported by the slave
  Reason refusal{};             // why the last requested engagement has not been granted
  bool refusal_is_far = false;  // `refusal` was reported by the slave
  std::uint64_t holds = 0;      // number of holds so far, that is, of exits from Engaged
  Reason last_hold{};           // cause of the last hold
  double far_age_s = 0.0;       // time since the newest telemetry arrived
  double moved_out_m = 0.0;     // by which the goal moved out of the surfaces during this contact (Mapping)
  double withheld_n =
      0.0;           // force of the contact spring that is not rendered because the energy for it is lacking
  bool held = true;  // a hand is on the handle
  /// Reported stiffness of the surface with the largest force, and of the stop with the largest moment, at the tool; 0: it is
  /// not known.
  double surface_n_per_m = 0.0, stop_nm_per_rad = 0.0;
  double hold_silence_s = 0.0;  // longest time without a datagram during the current or last hold

  /// Returns the requested gripper state if there is a pending request, otherwise the reported one.
  [[nodiscard]] bool gripper_closed() const { return grip.value_or(far_gripper_closed); }
};

struct MasterOutput {
  Wrench F_H_M{};                          // wrench to render on the hand
  std::optional<MotionCommand> command{};  // command to send in this tick; none: nothing to send
  std::uint64_t sequence = 0;              // sequence number of the command
};

class MasterNode {
 public:
  explicit MasterNode(const MasterConfig& config);
  ~MasterNode();

  /// Advances by one tick.
  MasterOutput step(const MasterInput& input);

  /// Takes effect in the next step. Fields that can change only at start-up are ignored.
  void configure(const MasterConfig& config);

  /// Returns the view after the last step.
  [[nodiscard]] const MasterView& view() const;
  /// Returns true while the fields that must not change during an engagement are locked.
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` would come more than safety.gap_s after the previous tick. If so, data
  /// that arrived in between is too old to use.
  [[nodiscard]] bool stalled(Time now) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
