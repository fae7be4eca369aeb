#pragma once
// Sent by the slave to the master at 30 to 60 Hz, for display and logging only. Code that moves a motor must
// not read it.

#include <array>
#include <cstdint>

#include "common/link/stiffness_report.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

constexpr int kMaxJoints = 6;

/// Limits that were active at the slave since the previous datagram.
struct Clamps {
  bool tool_speed = false;
  bool joint_speed = false;
  bool joint_position = false;
  bool workspace = false;
  bool force_guard = false;
  bool singularity = false;
  bool unreachable = false;
  /// Acceleration limit of tool or joints. For statistics only, because every change of motion reaches this
  /// limit.
  bool acceleration = false;
  bool moment_guard = false;
  /// With joint_position: the joint at its limit, from 1; negative: at its lower limit.
  int joint = 0;
};

/// Validity of an estimate. With kNoPowerLaw the contact does not follow a power law, and the stiffness is the
/// slope of the force over the probed depth.
enum class Verdict : std::uint8_t { kNotYet, kIdentified, kNotIdentifiable, kNoPowerLaw };

/// Current result of the estimator for the law F = k p^n + λ p^n p', p the depth.
struct ContactEstimate {
  double stiffness_n_per_m = 0.0;     // tangent stiffness dF/dp of the elastic force at the current depth
  double stiffness_sd_n_per_m = 0.0;  // one standard deviation
  double k = 0.0;                     // N/m^n
  double lambda = 0.0;                // N s/m^(n+1)
  double n = 1.0;                     // exponent
  double depth_m = 0.0;               // current depth below the estimated surface
  bool valid = false;                 // false: not yet identified, or no contact
  double secant_n_per_m = 0.0;        // secant stiffness F/p at the current depth: tangent stiffness over n
  double k_sd = 0.0, lambda_sd = 0.0, n_sd = 0.0;
  double correlation = 0.0;  // correlation of k and λ
  Verdict stiffness_verdict = Verdict::kNotYet;
  Verdict k_verdict = Verdict::kNotYet;
  Verdict lambda_verdict = Verdict::kNotYet;
  Verdict n_verdict = Verdict::kNotYet;
};

struct GripperState {
  bool closed = false;
  bool holds = false;       // the gripper holds a load
  double load_kg = 0.0;     // identified mass of the load
  double load_sd_kg = 0.0;  // standard deviation; 0: mass unknown
};

struct Telemetry {
  SafetyState state = SafetyState::kIdle;
  HoldCause cause = HoldCause::kNone;
  std::uint32_t engagement = 0;
  Pose X_WE{};                                 // measured tool pose
  Pose X_WE_goal{};                            // goal that the robot follows
  std::array<double, kMaxJoints> joint_rad{};  // measured positions; m for a prismatic joint
  Wrench F_E_W{};                              // measured wrench of the environment on the tool
  ContactEstimate estimate{};
  double penetration_m = 0.0;  // measured depth below the estimated surface; 0 without contact
  Clamps clamps{};
  // Statistics of the direction from master to slave.
  double up_loss = 0.0;      // fraction of datagrams lost
  double up_jitter_s = 0.0;  // standard deviation of the one-way delay
  double playout_delay_s = 0.0;
  std::uint64_t rejected = 0;  // dropped datagrams, all reasons
  std::uint64_t limit_violations = 0;
  std::uint64_t late_ticks = 0;  // ticks that were more than 100 ms late
  GripperState gripper{};
  std::uint32_t reduced = 0;  // bits of Protection (protection.hpp): protections that do not act
};

}  // namespace longreach
