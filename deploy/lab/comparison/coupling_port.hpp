#pragma once
// Input and output of a comparison law at the slave in one tick. The tool is an ideal position servo: it is
// always at the last setpoint.

#include <optional>

#include "deploy/lab/comparison/comparison_report.hpp"

namespace longreach {

struct CouplingInput {
  std::optional<ComparisonCommand> command{};  // newest command that arrived in this tick, if any
  Vector3 force_n = Vector3::Zero();           // measured force of the environment on the tool
};

struct CouplingOutput {
  Vector3 setpoint_m = Vector3::Zero();  // position setpoint of the tool, relative to the anchor
  ComparisonReport report{};             // report that must be sent in this tick
};

/// Returns the part of a step that an energy budget permits. A step against the force costs -F·dx; the part
/// that exceeds `budget_j` (a negative budget is treated as zero) is removed along the force.
inline Vector3 paid_step(const Vector3& step_m, const Vector3& force_n, double budget_j) {
  const double missing_j = -force_n.dot(step_m) - (budget_j > 0.0 ? budget_j : 0.0);
  const double f2 = force_n.squaredNorm();
  return missing_j > 0.0 && f2 > 0.0 ? Vector3(step_m + missing_j / f2 * force_n) : step_m;
}

/// Returns the step `gap_m` to the goal, shortened to at most `longest_m`.
inline Vector3 limited_step(const Vector3& gap_m, double longest_m) {
  const double length_m = gap_m.norm();
  return length_m > longest_m ? Vector3(gap_m * (longest_m / length_m)) : gap_m;
}

}  // namespace longreach
