#include "slave/estimation/reported_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {

bool ReportedStiffness::step(const SecantEstimate& estimate, const Vector3& normal) {
  if (!estimate.valid) return false;
  const double value = estimate.stiffness_n_per_m;
  const double sd = estimate.stiffness_sd_n_per_m / value;
  if (!(sd < config_.first_sd)) return false;  // nothing is replaced by what is hardly known
  if (stiffness_n_per_m_ > 0.0) {
    // ‖S n nᵀ - S' n' n'ᵀ‖² = (S - S')² + 2 S S' |n × n'|²
    const double off = std::sqrt(std::pow(value - stiffness_n_per_m_, 2) +
                                 2.0 * value * stiffness_n_per_m_ * normal.cross(normal_).squaredNorm()) /
                       stiffness_n_per_m_;
    const bool large = off > std::max(config_.deadband, 3.0 * sd);
    const bool refined = !corrected_ && sd < 0.01 && off > std::max(0.02, 3.0 * sd);
    if (!large && !refined) return false;
    if (!large) corrected_ = true;
  }
  stiffness_n_per_m_ = value;
  depth_m_ = estimate.depth_m;
  normal_ = normal;
  return true;
}

}  // namespace longreach
