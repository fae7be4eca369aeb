#pragma once
// One complete docking in the laboratory: the scene `dock` with a simulated operator and a link.

#include <cstdint>

#include "deploy/lab/contact/docking_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct DockingOutcome {
  bool grasped = false;
  bool docked = false;        // the target is latched, the gripper released it, and the operator finished
  bool felt_success = false;  // the force at the hand rose and vanished
  double grasped_s = 0.0, latched_s = 0.0, ended_s = 0.0;
  /// Maximum contact force at the hand against the push, until the operator perceives the latch, N.
  double felt_success_n = 0.0;
  double felt_mistake_n = 0.0;  // same, during the mistake
  double tool_force_max_n = 0.0;
  double target_speed_max_m_per_s = 0.0;
  double target_speed_end_m_per_s = 0.0;
  double port_energy_min_j = 0.0;
  /// Energy created by the scene: stored energy plus losses minus the work done on it.
  double energy_created_j = 0.0;
  std::uint64_t limit_violations = 0, unconverged = 0;
  bool ended = false;  // the operator finished
  /// True if there was no fault, stop or violated limit, every contact converged, the tool force stayed
  /// within the promise of the force guard, and the target stayed slow.
  bool safe = false;
};

DockingOutcome dock(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake, Trace* trace);

/// Creates the trace of a docking with its columns.
Trace docking_trace(const std::filesystem::path& folder, std::string_view name);

}  // namespace longreach
