#pragma once
// One docking from beginning to end in the laboratory: scene `dock`, a simulated operator, a link.

#include <cstdint>

#include "deploy/lab/contact/docking_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct DockingOutcome {
  bool grasped = false;
  bool docked = false;        // latched, released, and the target stays there
  bool felt_success = false;  // at the hand a force rose and vanished
  double grasped_s = 0.0, latched_s = 0.0, ended_s = 0.0;
  double felt_success_n = 0.0;  // greatest contact force at the hand against the push, up to the latch's news
  double felt_mistake_n = 0.0;  // likewise, of the mistake
  double tool_force_max_n = 0.0;
  double target_speed_max_m_per_s = 0.0;
  double target_speed_end_m_per_s = 0.0;
  double port_energy_min_j = 0.0;
  double energy_created_j = 0.0;  // by the scene: stored more than was done on it
  std::uint64_t limit_violations = 0, unconverged = 0;
  bool ended = false;  // the operator came to his end
  bool safe = false;   // no fault or stop, no limit broken, the force guard kept, the target left slow
};

DockingOutcome dock(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake, Trace* trace);

/// The columns of the trace.
Trace docking_trace(const std::filesystem::path& folder, std::string_view name);

}  // namespace longreach
