#pragma once
// First-order low-pass filter: x += share (input - x).

#include <cmath>

namespace longreach {

/// Returns the share by which a filter with the time constant `tau_s` approaches its input within `dt` s;
/// 1 if `tau_s` is not positive, which means no filter.
inline double low_pass_share(double dt, double tau_s) { return tau_s > 0.0 ? -std::expm1(-dt / tau_s) : 1.0; }

}  // namespace longreach
