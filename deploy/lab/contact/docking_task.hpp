#pragma once
// One complete docking in the laboratory: scene `dock`, a simulated operator, a link.

#include <cstdint>

#include "deploy/lab/contact/docking_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct DockingOutcome {
  bool grasped = false;
  bool docked = false;        // latched, released, and the target stays in place
  bool felt_success = false;  // a force at the hand rose and vanished
  double grasped_s = 0.0, latched_s = 0.0, ended_s = 0.0;
  /// maximum contact force at the hand against the push, until the report of the latch
  double felt_success_n = 0.0;
  double felt_mistake_n = 0.0;  // likewise, for the mistake
  double tool_force_max_n = 0.0;
  double target_speed_max_m_per_s = 0.0;
  double target_speed_end_m_per_s = 0.0;
  double port_energy_min_j = 0.0;
  double energy_created_j = 0.0;  // by the scene: stored energy minus work done on it
  std::uint64_t limit_violations = 0, unconverged = 0;
  bool ended = false;  // the operator has finished
  bool safe = false;  // no fault or stop, no limit violated, the force guard kept, the target slow at the end
};

DockingOutcome dock(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake, Trace* trace);

/// The columns of the trace.
Trace docking_trace(const std::filesystem::path& folder, std::string_view name);

}  // namespace longreach
