#pragma once
// What the textbook laws of bilateral teleoperation send across the link, once a tick each way. They exist in
// the laboratory, for comparison: the law of this system sees StiffnessReports only.

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Master to slave.
struct ComparisonCommand {
  Vector3 position_m = Vector3::Zero();  // of the handle, W, from the anchor
  Vector3 wave = Vector3::Zero();        // u, √W (WAVE)
  double energy_j = 0.0;                 // TDPA: entered at the master's port; TANK: sent so far. Only grows
};

/// Slave to master.
struct ComparisonReport {
  Vector3 position_m = Vector3::Zero();  // of the tool, W, from the anchor
  Vector3 force_n = Vector3::Zero();     // by the environment on the tool, W
  Vector3 wave = Vector3::Zero();        // w, √W (WAVE)
  double energy_j = 0.0;                 // TDPA: entered at the slave's port; TANK: sent so far. Only grows
};

}  // namespace longreach
