#pragma once
// Limits that follow from the parameters of the rendering.

#include "schema/config_master.hpp"

namespace longreach {

/// Maximum energy that the port may return beyond what it received since the start of an engagement, J. This
/// is the initial store plus the apparent energy that encoder quantization can produce without a real leak.
inline double returned_most_j(const RenderingConfig& c = {}) {
  constexpr double kSteps_j = 1e-3;
  return c.store_j + kSteps_j;
}

}  // namespace longreach
