#pragma once
// Data that the textbook laws of bilateral teleoperation exchange in every tick. They exist in the laboratory
// only, for comparison: the law of this system uses StiffnessReports only.

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Master to slave.
struct ComparisonCommand {
  Vector3 position_m = Vector3::Zero();  // of the handle, W, from the anchor
  Vector3 wave = Vector3::Zero();        // u, √W (WAVE)
  /// TDPA: energy that entered the master's port; TANK: total sent energy. Non-decreasing
  double energy_j = 0.0;
};

/// Slave to master.
struct ComparisonReport {
  Vector3 position_m = Vector3::Zero();  // of the tool, W, from the anchor
  Vector3 force_n = Vector3::Zero();     // by the environment on the tool, W
  Vector3 wave = Vector3::Zero();        // w, √W (WAVE)
  /// TDPA: energy that entered the slave's port; TANK: total sent energy. Non-decreasing
  double energy_j = 0.0;
};

}  // namespace longreach
