#include "master/rendering/port_guard.hpp"

namespace longreach {

double PortGuard::observe(const Vector3& moved) {
  const double energy_j = -f_last_.dot(moved);
  port_energy_j_ += energy_j;
  return energy_j;
}

double PortGuard::repay(double energy_j) {
  const double paid = std::min(energy_j, deficit_j_);
  deficit_j_ -= paid;
  return energy_j - paid;
}

double PortGuard::freed_damping(double dt_s) {
  constexpr double kBegin_s = 0.02, kEnd_s = 0.2;
  freed_share_ = freed_s_ > 0.0 ? std::min(1.0, freed_share_ + dt_s / kBegin_s)
                                : std::max(0.0, freed_share_ - dt_s / kEnd_s);
  freed_s_ = std::max(0.0, freed_s_ - dt_s);
  return freed_share_ * std::min(config_.freed_damping, 0.4 * config_.handle_mass / dt_s);
}

Vector3 PortGuard::apply(const PortForce& in, double dt_s) {
  gain_ = in.live ? gain_ : std::max(0.0, gain_ - dt_s / config_.ramp_s);
  Vector3 out = gain_ * in.rendered + in.always;
  clamped_ = injecting_ = false;
  if (out.allFinite() && in.rate.allFinite()) {
    const double v2 = in.rate.squaredNorm();
    injecting_ = gain_ > 0.0 && deficit_j_ > 0.0 && v2 > 0.0;
    if (injecting_)
      out -= gain_ * std::min(deficit_j_ / (v2 * dt_s), 0.4 * config_.handle_mass / dt_s) * in.rate;
    out -= freed_damping(dt_s) * in.rate;
    // Only increases are limited; a decreasing force needs no limit.
    const Vector3 rise = out - f_given_;
    const double most = config_.slew_per_s * dt_s;
    if (out.squaredNorm() > f_given_.squaredNorm() && norm(rise) > most) {
      out = f_given_ + clamp_norm(rise, most);
      clamped_ = true;
    }
    clamped_ = clamped_ || norm(out) > config_.force_max;
    out = clamp_norm(out, config_.force_max);
  }
  if (!out.allFinite()) out.setZero();
  return f_given_ = f_last_ = out;
}

}  // namespace longreach
