#pragma once
// One tick of a run as observed from outside: the true state of the plant, the data that the parts exchanged,
// and the active faults. It is the only input of the oracle.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/faults/kind.hpp"
#include "tests/faults/sent_log.hpp"

namespace longreach {

constexpr std::size_t kAffects = 12;

struct Moment {
  double t_s = 0.0;
  double period_s = 0.001;
  bool faults_over = false;

  // Slave side. Inputs and outputs are valid only in ticks in which the slave ran.
  bool slave_ran = false, master_ran = false;
  double slave_gap_s = 0.0;  // time between the last two ticks of the slave
  double master_gap_s = 0.0;
  /// True state of the robot, before any falsification.
  RobotState truth{};
  RobotState reported{};                           // state of the robot that the slave received
  JointVector setpoint_rad = JointVector::Zero();  // setpoint that the slave wrote
  bool moves = false;                              // the slave wrote a setpoint
  Pose X_WE{};                                     // true pose of the tool
  Vector3 v_WE = Vector3::Zero();
  Wrench F_E_W{};
  std::size_t given = 0;                       // number of commands that the slave received in this tick
  std::vector<std::uint64_t> given_numbers{};  // their sequence numbers
  /// True if the slave accepted a command that was not sent in this form.
  bool given_badly = false;
  bool stop_at_slave = false;               // a stop was requested in this tick
  bool taken = false, renewed = false;      // the slave got the session of another master, or a new one
  std::optional<StiffnessReport> report{};  // as sent
  std::optional<Telemetry> telemetry{};
  /// State claimed in the last report.
  SafetyState claimed = SafetyState::kIdle;
  HoldCause cause = HoldCause::kNone;
  std::uint32_t engagement = 0;

  // Master side.
  Vector3 x_MH = Vector3::Zero();  // true position of the handle
  Quaternion q_MH = Quaternion::Identity();
  HandleState handle{};                // state of the handle that the master received
  Wrench F_H_M{};                      // wrench on the hand that the master wrote
  Vector3 goal_m = Vector3::Zero();    // commanded goal, relative to the anchor
  Vector3 anchor_m = Vector3::Zero();  // anchor of the engagement, in W
  double contact_n = 0.0;              // contribution of the contact to the force on the hand
  bool engage_asked = false, hold_asked = false, stop_asked = false;
  bool report_came = false;   // the master received a new report
  double report_age_s = 0.0;  // age of the last report that the master received
  /// Stiffness that the master reports as being rendered, along `rendered_along`.
  double rendered_n_per_m = 0.0;
  Vector3 rendered_along = Vector3::Zero();
  double rendered_from_m = 0.0;            // position of the rendered surface
  bool felt = false;                       // the rendered surface exerts a force
  SafetyState shown = SafetyState::kIdle;  // as displayed
  /// Displayed reason why the robot does not follow the goal or why an engagement is not granted.
  Reason reason{};
  bool reason_is_far = false;
  std::uint32_t engaged_in = 0;  // number of the master's current engagement
  /// The telemetry, if the master received one in this tick.
  std::optional<Telemetry> seen{};

  // Network and limits.
  std::uint64_t datagrams = 0;  // number of datagrams sent in this tick
  /// True if one of these datagrams has a sequence number that was used before.
  bool number_again = false;
  /// Number of datagrams that arrived at the two ports, and the number accounted for by their
  /// counters.
  std::uint64_t received = 0, accounted = 0;
  bool configured = false;  // a client changed a setting
  /// Limits that are less restrictive than those of the configuration files.
  std::string loosened;

  const SentLog* sent_log = nullptr;
  /// Time since the signal was last affected, s; 0: it is affected now.
  std::array<double, kAffects> affected_s{};

  /// Time since the signal was last affected, s; 0: it is affected now.
  [[nodiscard]] double since(AffectedSignal what) const {
    return affected_s[static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(what)))];
  }
};

}  // namespace longreach
