#include "slave/sensing/bond_lag.hpp"

#include <cmath>

#include "common/core/low_pass.hpp"

namespace longreach {
namespace {

constexpr double kHighPass_s = 0.05;
constexpr double kMemory_s = 20.0;
constexpr double kFree_s = 0.3;  // after a contact, until bond and load are at rest
constexpr double kWell =
    1e3;  // force that counts as well above the noise: its square relative to the noise's

}  // namespace

double BondLag::lag_of(std::size_t i) {
  return kUsual_s * std::pow(2.0, 0.5 * (static_cast<double>(i) - static_cast<double>(kUsual)));
}

void BondLag::step(const Vector3& force_n, const Vector3& m_per_s2, bool free, const SensingConfig& sensing,
                   double dt) {
  if (!force_n.allFinite() || !m_per_s2.allFinite() || !(dt > 0.0)) return;
  const double share = low_pass_share(dt, sensing.filter_s), slow = low_pass_share(dt, kHighPass_s);
  force_n_ += share * (force_n - force_n_);
  m_per_s2_ += share * (m_per_s2 - m_per_s2_);
  mean_n_ += slow * (force_n_ - mean_n_);
  free_s_ = free ? free_s_ + dt : 0.0;
  const double kept = std::exp(-dt / kMemory_s);
  for (std::size_t i = 0; i < kLags; ++i) {
    Candidate& c = candidates_[i];
    c.m_per_s2 += low_pass_share(dt, lag_of(i)) * (m_per_s2_ - c.m_per_s2);
    c.mean_m_per_s2 += slow * (c.m_per_s2 - c.mean_m_per_s2);
    if (free_s_ < kFree_s) continue;
    const Vector3 a = c.m_per_s2 - c.mean_m_per_s2;
    c.product = kept * c.product + dt * a.dot(force_n_ - mean_n_);
    c.square = kept * c.square + dt * a.squaredNorm();
  }
  best_ = kUsual;
  const double noise_n = sensing.force_noise_n + sensing.force_resolution_n;
  const double well = kWell * noise_n * noise_n * dt;  // white noise explains σ² dt of itself
  for (std::size_t i = 0; i < kLags; ++i) {
    const double explained = candidates_[i].explained();
    if (explained > well && explained > candidates_[best_].explained()) best_ = i;
  }
}

}  // namespace longreach
