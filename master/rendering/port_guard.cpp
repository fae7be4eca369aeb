#include "master/rendering/port_guard.hpp"

#include <algorithm>

namespace longreach {

void PortGuard::reset(const Vector3& x_m) {
  x_last_ = x_m;
  f_last_.setZero();
  deficit_j_ = 0.0;
}

double PortGuard::observe(const Vector3& x_m) {
  const double energy_j = -f_last_.dot(x_m - x_last_);
  x_last_ = x_m;
  port_energy_j_ += energy_j;
  port_energy_min_j_ = std::min(port_energy_min_j_, port_energy_j_);
  return energy_j;
}

double PortGuard::repay(double energy_j) {
  const double paid = std::min(energy_j, deficit_j_);
  deficit_j_ -= paid;
  return energy_j - paid;
}

Wrench PortGuard::apply(const Wrench& F, const Wrench& always, const Vector3& velocity_m_per_s, bool live,
                        double dt_s) {
  gain_ = live ? gain_ : std::max(0.0, gain_ - dt_s / config_.ramp_s);
  Wrench out;
  if ((F.force + always.force).allFinite() && (F.moment + always.moment).allFinite() &&
      velocity_m_per_s.allFinite()) {
    const double v2 = velocity_m_per_s.squaredNorm();
    injecting_ = deficit_j_ > 0.0 && v2 > 0.0;
    Vector3 force = F.force;
    if (injecting_) {
      const double damping = std::min(deficit_j_ / (v2 * dt_s), 0.4 * config_.handle_mass_kg / dt_s);
      force -= damping * velocity_m_per_s;
    }
    force = gain_ * force + always.force;
    force_clamped_ = force.stableNorm() > config_.force_max_n;
    out.force = clamp_norm(force, config_.force_max_n);
    out.moment = clamp_norm(gain_ * F.moment + always.moment, config_.moment_max_nm);
  }
  f_last_ = out.force;
  return out;
}

}  // namespace longreach
