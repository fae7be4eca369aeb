#pragma once
// One complete docking in the laboratory: the scene `dock` with a simulated operator and a link.

#include <cstdint>

#include "deploy/lab/contact/docking_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct DockingOutcome {
  bool grasped = false;
  /// The target is latched, the gripper has released it, and the operator has finished.
  bool docked = false;
  bool felt_success = false;  // the force at the hand rose and vanished
  double grasped_s = 0.0, latched_s = 0.0, ended_s = 0.0;
  /// Maximum contact force on the hand against the direction of pushing, until the operator feels the latch
  /// engage, N.
  double felt_success_n = 0.0;
  double felt_mistake_n = 0.0;    // the same force during the mistake
  double tool_force_max_n = 0.0;  // includes the inertial force of the target
  /// Maximum force with which the tool or the target presses on anything else, without the inertial force of the
  /// target, N. It is computed from the momentum of the bodies in the scene.
  double pressed_max_n = 0.0;
  double target_speed_max_m_per_s = 0.0;
  double target_speed_end_m_per_s = 0.0;
  double port_energy_min_j = 0.0;
  /// Energy created by the scene: stored energy plus losses minus the work done on the scene.
  double energy_created_j = 0.0;
  std::uint64_t limit_violations = 0, unconverged = 0;
  bool ended = false;  // the operator finished
  /// True if there was no fault, stop or limit violation, every contact computation converged, the pressing
  /// force remained below the maximum that the force guard permits, and the target moved slowly.
  bool safe = false;
};

DockingOutcome dock(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake, Trace* trace);

/// Creates the trace of a docking with its columns.
Trace docking_trace(const std::filesystem::path& folder, std::string_view name);

}  // namespace longreach
