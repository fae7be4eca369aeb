#pragma once
// One tick of a run as seen from outside: the true state of the plant, the data exchanged between the parts,
// and the active faults. It is the only input of the oracle.

#include <array>
#include <optional>
#include <string>

#include "tests/faults/kind.hpp"
#include "tests/faults/sent_log.hpp"

namespace longreach {

constexpr std::size_t kAffects = 12;

struct Moment {
  double t_s = 0.0;
  double period_s = 0.001;
  bool faults_over = false;

  // Slave side. Its inputs and outputs are valid in ticks in which it ran.
  bool slave_ran = false, master_ran = false;
  double slave_gap_s = 0.0;  // between its last two ticks
  double master_gap_s = 0.0;
  RobotState truth{};  // of the robot, before any falsification
  RobotState reported{};
  JointVector setpoint_rad = JointVector::Zero();  // as written by the slave
  bool moves = false;                              // the slave wrote a setpoint
  Pose X_WE{};                                     // true pose
  Vector3 v_WE = Vector3::Zero();
  Wrench F_E_W{};
  std::size_t given = 0;                    // commands in this tick
  bool given_badly = false;                 // the slave accepted a command that was never sent so
  bool stop_at_slave = false;               // a stop was requested in this tick
  std::optional<StiffnessReport> report{};  // as sent
  std::optional<Telemetry> telemetry{};
  SafetyState claimed = SafetyState::kIdle;  // of the last report
  HoldCause cause = HoldCause::kNone;
  std::uint32_t engagement = 0;

  // Master side.
  Vector3 x_MH = Vector3::Zero();  // true position
  Quaternion q_MH = Quaternion::Identity();
  HandleState handle{};                // as received by the master
  Wrench F_H_M{};                      // as written by the master
  Vector3 goal_m = Vector3::Zero();    // commanded, from the anchor
  Vector3 anchor_m = Vector3::Zero();  // of the engagement, in W
  double contact_n = 0.0;              // part of the force on the hand that the contact causes
  bool engage_asked = false, hold_asked = false, stop_asked = false;
  bool report_came = false;       // the master received a newest report
  double report_age_s = 0.0;      // of the last one received
  double rendered_n_per_m = 0.0;  // as reported by the master, along:
  Vector3 rendered_along = Vector3::Zero();
  double rendered_from_m = 0.0;            // position of its surface
  bool felt = false;                       // with a force above zero
  SafetyState shown = SafetyState::kIdle;  // as displayed
  Reason reason{};  // displayed: why the robot does not follow, or an engagement is not granted
  bool reason_is_far = false;
  std::uint32_t engaged_in = 0;     // number of the master's engagement
  std::optional<Telemetry> seen{};  // newest telemetry that the master received, if it arrived in this tick

  // Network and limits.
  std::uint64_t datagrams = 0;                // sent in this tick
  bool number_again = false;                  // one of them has a number that was used before
  std::uint64_t received = 0, accounted = 0;  // by both ports
  bool configured = false;                    // a client has changed a setting
  std::string loosened;                       // limits that are less restrictive than those of the files

  const SentLog* sent_log = nullptr;
  std::array<double, kAffects> affected_s{};  // since when the signal is unaffected; 0: it is affected

  /// Seconds since it was last affected; 0 while it is.
  [[nodiscard]] double since(AffectedSignal what) const {
    return affected_s[static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(what)))];
  }
};

}  // namespace longreach
