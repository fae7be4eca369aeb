#pragma once
// Input and output of one tick of a comparison law.

#include <optional>

#include "deploy/lab/comparison/comparison_report.hpp"

namespace longreach {

struct ComparisonInput {
  Vector3 position_m = Vector3::Zero();        // handle position in the slave's frame and scale
  Vector3 velocity_m_per_s = Vector3::Zero();  // mean velocity since the last tick
  std::optional<ComparisonReport> report{};    // newest report that arrived in this tick, if any
};

struct ComparisonOutput {
  Vector3 force_n = Vector3::Zero();  // force on the hand, held until the next tick
  ComparisonCommand command{};        // command to send in this tick
};

}  // namespace longreach
