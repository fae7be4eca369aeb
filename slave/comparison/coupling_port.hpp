#pragma once
// What the slave's end of every comparison law is given once a tick, and what it returns. The tool is an
// ideal position servo: it is where the last setpoint put it.

#include <optional>

#include "common/link/comparison_report.hpp"

namespace longreach {

struct CouplingInput {
  std::optional<ComparisonCommand> command{};  // newest that arrived in this tick
  Vector3 force_n = Vector3::Zero();           // measured, by the environment on the tool
};

struct CouplingOutput {
  Vector3 setpoint_m = Vector3::Zero();  // of the tool, from the anchor
  ComparisonReport report{};             // to send now
};

/// The part of a step that an energy budget pays for: a step against the force costs -F·dx, and what it costs
/// above `budget_j` (nothing, if that is negative) is taken away along the force.
inline Vector3 paid_step(const Vector3& step_m, const Vector3& force_n, double budget_j) {
  const double missing_j = -force_n.dot(step_m) - (budget_j > 0.0 ? budget_j : 0.0);
  const double f2 = force_n.squaredNorm();
  return missing_j > 0.0 && f2 > 0.0 ? Vector3(step_m + missing_j / f2 * force_n) : step_m;
}

/// A step of at most `longest_m` towards the goal.
inline Vector3 limited_step(const Vector3& gap_m, double longest_m) {
  const double length_m = gap_m.norm();
  return length_m > longest_m ? Vector3(gap_m * (longest_m / length_m)) : gap_m;
}

}  // namespace longreach
