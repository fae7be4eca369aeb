#pragma once
// Slave to master, 30 to 60 Hz, for display and log only. No code that moves a motor may read it.

#include <array>
#include <cstdint>

#include "common/link/stiffness_report.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

constexpr int kMaxJoints = 6;

/// Limits that the slave has applied since the last datagram.
struct Clamps {
  bool tool_speed = false;
  bool joint_speed = false;
  bool joint_position = false;
  bool workspace = false;
  bool force_guard = false;
  bool singularity = false;
  bool unreachable = false;
  bool acceleration =
      /// limit of tool or joints, for statistics; every change of motion reaches it, so it is not a warning
      false;
  bool moment_guard = false;
};

/// Validity of an estimate.
/// kNoPowerLaw: the contact does not follow a power law; the stiffness is then the slope of the force over
/// the probed depth.
enum class Verdict : std::uint8_t { kNotYet, kIdentified, kNotIdentifiable, kNoPowerLaw };

/// Present result of the estimator.
struct ContactEstimate {
  double stiffness_n_per_m = 0.0;     // tangent dF/dp of the elastic force at the present depth
  double stiffness_sd_n_per_m = 0.0;  // one standard deviation
  double k = 0.0;                     // N/m^n
  double lambda = 0.0;                // N s/m^(n+1)
  double n = 1.0;                     // exponent
  double depth_m = 0.0;               // present depth below the estimated surface
  bool valid = false;                 // false: not yet identified, or no contact
  double secant_n_per_m = 0.0;        // F/p of the elastic force at the present depth: stiffness over n
  double k_sd = 0.0, lambda_sd = 0.0, n_sd = 0.0;
  double correlation = 0.0;  // of k and λ
  Verdict stiffness_verdict = Verdict::kNotYet;
  Verdict k_verdict = Verdict::kNotYet;
  Verdict lambda_verdict = Verdict::kNotYet;
  Verdict n_verdict = Verdict::kNotYet;
};

struct GripperState {
  bool closed = false;
  bool holds = false;       // the gripper holds a load
  double load_kg = 0.0;     // identified mass of the load
  double load_sd_kg = 0.0;  // 0: not known
};

struct Telemetry {
  SafetyState state = SafetyState::kIdle;
  HoldCause cause = HoldCause::kNone;
  std::uint32_t engagement = 0;
  Pose X_WE{};                                 // measured tool pose
  Pose X_WE_goal{};                            // goal that the robot follows
  std::array<double, kMaxJoints> joint_rad{};  // measured
  Wrench F_E_W{};                              // measured, by the environment on the tool
  ContactEstimate estimate{};
  double penetration_m = 0.0;  // measured depth below the estimated surface; 0 without contact
  Clamps clamps{};
  // Statistics of the direction from the master.
  double up_loss = 0.0;      // fraction
  double up_jitter_s = 0.0;  // standard deviation of the one-way time
  double playout_delay_s = 0.0;
  std::uint64_t rejected = 0;  // datagrams dropped, all reasons
  std::uint64_t limit_violations = 0;
  std::uint64_t late_ticks = 0;  // ticks late by over 100 ms
  GripperState gripper{};
};

}  // namespace longreach
