#pragma once
// Data that the textbook control laws of bilateral teleoperation exchange in every tick. These laws exist
// only in the laboratory, for comparison; the rendering of this system uses only StiffnessReports.

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Sent by the master to the slave.
struct ComparisonCommand {
  Vector3 position_m = Vector3::Zero();  // handle position relative to the anchor, W
  Vector3 wave = Vector3::Zero();        // u, √W (WAVE)
  /// TDPA: energy that entered the master's port. TANK: total energy sent. Never decreases.
  double energy_j = 0.0;
};

/// Sent by the slave to the master.
struct ComparisonReport {
  Vector3 position_m = Vector3::Zero();  // tool position relative to the anchor, W
  Vector3 force_n = Vector3::Zero();     // force of the environment on the tool, W
  Vector3 wave = Vector3::Zero();        // w, √W (WAVE)
  /// TDPA: energy that entered the slave's port. TANK: total energy sent. Never decreases.
  double energy_j = 0.0;
};

}  // namespace longreach
