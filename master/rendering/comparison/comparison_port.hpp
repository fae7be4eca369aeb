#pragma once
// Input and output of a comparison law in a tick.

#include <optional>

#include "common/link/comparison_report.hpp"

namespace longreach {

struct ComparisonInput {
  Vector3 position_m = Vector3::Zero();        // of the handle, in the slave's frame and scale
  Vector3 velocity_m_per_s = Vector3::Zero();  // mean since the last tick
  std::optional<ComparisonReport> report{};    // newest report that arrived in this tick
};

struct ComparisonOutput {
  Vector3 force_n = Vector3::Zero();  // on the hand, held until the next tick
  ComparisonCommand command{};        // to send now
};

}  // namespace longreach
