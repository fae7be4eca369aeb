#pragma once
// One tick of a run as an outsider has seen it: the plant's truth, what passed between the parts, what was
// wrong. The oracle reads nothing else.

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

  // The slave's side; what it was told and answered counts in ticks in which it ran.
  bool slave_ran = false, master_ran = false;
  double slave_gap_s = 0.0;  // between its last two ticks
  double master_gap_s = 0.0;
  RobotState truth{};  // of the robot, before anybody lied about it
  RobotState reported{};
  JointVector setpoint_rad = JointVector::Zero();  // as the slave wrote it
  bool moves = false;                              // the slave wrote a setpoint
  Pose X_WE{};                                     // true
  Vector3 v_WE = Vector3::Zero();
  Wrench F_E_W{};
  std::size_t given = 0;                    // commands, in this tick
  bool given_badly = false;                 // the slave took a command that nobody sent so
  bool stop_at_slave = false;               // asked for in this tick
  std::optional<StiffnessReport> report{};  // as it left
  std::optional<Telemetry> telemetry{};
  SafetyState claimed = SafetyState::kIdle;  // of the last report
  HoldCause cause = HoldCause::kNone;
  std::uint32_t engagement = 0;

  // The master's side.
  Vector3 x_MH = Vector3::Zero();  // true
  Quaternion q_MH = Quaternion::Identity();
  HandleState handle{};                // as told
  Wrench F_H_M{};                      // as written
  Vector3 goal_m = Vector3::Zero();    // commanded, from the anchor
  Vector3 anchor_m = Vector3::Zero();  // of the engagement, in W
  double contact_n = 0.0;              // of the force on the hand, the contact's share
  bool engage_asked = false, hold_asked = false, stop_asked = false;
  bool report_came = false;       // one that is newest was given to the master
  double report_age_s = 0.0;      // of the last that did
  double rendered_n_per_m = 0.0;  // as the master says, along:
  Vector3 rendered_along = Vector3::Zero();
  double rendered_from_m = 0.0;            // where its surface lies
  bool felt = false;                       // with some force
  SafetyState shown = SafetyState::kIdle;  // to the operator
  Reason reason{};  // likewise: why it does not follow, or an engagement is not granted
  bool reason_is_far = false;
  std::uint32_t engaged_in = 0;     // number of the master's engagement
  std::optional<Telemetry> seen{};  // newest telemetry that the master was given, if it came now

  // The wire and the rules.
  std::uint64_t datagrams = 0;                // that left in this tick
  bool number_again = false;                  // one of them under a number that has left before
  std::uint64_t received = 0, accounted = 0;  // by both ports
  bool configured = false;                    // a client has changed something
  std::string loosened;                       // limits that are looser than the files

  const SentLog* sent_log = nullptr;
  std::array<double, kAffects> affected_s{};  // since when this is as it should be; 0: it is not

  /// Seconds since it was spoilt last, 0 while it is.
  [[nodiscard]] double since(AffectedSignal what) const {
    return affected_s[static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(what)))];
  }
};

}  // namespace longreach
