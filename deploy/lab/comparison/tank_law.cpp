#include "deploy/lab/comparison/tank_law.hpp"

#include <algorithm>

namespace longreach {
namespace {

/// Fraction of the target level; an abrupt cut-off would make the force chatter.
constexpr double kNearlyEmpty = 0.1;

}  // namespace

ComparisonOutput TankLaw::step(const ComparisonInput& in, double dt_s) {
  level_j_ -= force_n_.dot(in.velocity_m_per_s) * dt_s;
  if (in.report) {
    level_j_ += std::max(0.0, in.report->energy_j - far_.energy_j);
    far_ = *in.report;
  }
  const double quantum_j = std::max(0.0, level_j_) * config_.tank_share_per_s * dt_s;
  level_j_ -= quantum_j;
  sent_j_ += quantum_j;

  const double fill = config_.tank_n_s_per_m_per_j * std::max(0.0, config_.tank_level_j - level_j_);
  const double damping = std::min(fill, config_.handle_mass_kg / dt_s);
  const double open = std::clamp(level_j_ / (kNearlyEmpty * config_.tank_level_j), 0.0, 1.0);
  force_n_ = open * far_.force_n - damping * in.velocity_m_per_s;
  return {.force_n = force_n_, .command = {.position_m = in.position_m, .energy_j = sent_j_}};
}

}  // namespace longreach
