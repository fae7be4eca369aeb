#include "master/rendering/contact_spring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace longreach {
namespace {

constexpr double kLoad_s = 0.15, kFullForce_s = 0.4, kAtRest_s = 2.2;
constexpr double kVanish_s = 0.05;  // in which the greatest force vanishes
// Depth that may be lacking: a share of the whole depth, and a share of the force limit.
constexpr double kLacking = 0.1, kLackingForce = 1.0 / 150.0;

}  // namespace

void ContactSpring::begin(double s_m, double surface_m) {
  target_ = fading_ = last_n_ = depth_m_ = 0.0;
  clamped_ = yielding_ = unpaid_ = home_ = false;
  surface_m_ = surface_m;
  anchor_m_ = std::max(s_m, surface_m);
  s_slow_m_ = s_last_m_ = s_m;
  depth_max_m_ = std::numeric_limits<double>::infinity();
}

bool ContactSpring::set_stiffness(double s_m, double stiffness_n_per_m) {
  if (!std::isfinite(stiffness_n_per_m)) return false;
  const double wanted = std::clamp(stiffness_n_per_m, 0.0, config_.stiffness_max_n_per_m);
  clamped_ = wanted < stiffness_n_per_m;
  const double present = this->stiffness_n_per_m();
  if (wanted > present) {
    // The same force with less energy: f^2/2k decreases with increasing k.
    const double depth = std::max(0.0, s_m - anchor_m_);
    if (depth > 0.0) anchor_m_ = s_m - depth * (present / wanted);
    fading_ = 0.0;
  } else {
    fading_ = present - wanted;
  }
  target_ = wanted;
  return true;
}

bool ContactSpring::set_surface(double surface_m) {
  if (!std::isfinite(surface_m)) return false;
  surface_m_ = surface_m;
  return true;
}

double ContactSpring::step(double s_m, double dt_s, EnergySource source, double damper_n) {
  if (fading_ > 0.0) fading_ *= std::exp(-dt_s / config_.fade_s);
  if (fading_ < 1e-9 * config_.stiffness_max_n_per_m) fading_ = 0.0;
  const double k = stiffness_n_per_m();
  yielding_ = k * (s_m - anchor_m_) > config_.force_max_n;
  if (yielding_) anchor_m_ = s_m - config_.force_max_n / k;
  const bool lacks = return_anchor(s_m, dt_s, source);
  shorten(s_m, dt_s, damper_n);
  const double gap_m = anchor_m_ - surface_m_;
  if (lacks && gap_m > std::max(kLacking * (s_m - surface_m_), kLackingForce * config_.force_max_n / k))
    unpaid_ = true;
  if (!(gap_m > 0.0) || !(k > 0.0)) unpaid_ = false;
  s_slow_m_ -= std::expm1(-dt_s / config_.fade_s) * (s_m - s_slow_m_);
  depth_m_ = std::max(0.0, s_m - anchor_m_);
  s_last_m_ = s_m;
  return last_n_ = force_n(s_m);
}

void ContactSpring::shorten(double s_m, double dt_s, double damper_n) {
  shortened_n_ = 0.0;
  const double k = stiffness_n_per_m(), retreat_m = std::max(0.0, s_last_m_ - s_m);
  if (!(k > 0.0)) return;
  // The fall of a fading stiffness is part of the ramp.
  const double share = last_n_ > 0.0 ? std::clamp(damper_n / last_n_, 0.0, 1.0) : 0.0;
  const double least_n = last_n_ - config_.force_max_n * (dt_s / kVanish_s) / (1.0 + share);
  const double ramp_m = std::min(depth_m_, least_n / k) - retreat_m;
  const double before_n = force_n(s_m);
  anchor_m_ = std::max(anchor_m_, s_m - std::max(depth_max_m_, ramp_m));
  shortened_n_ = before_n - force_n(s_m);
}

bool ContactSpring::settled(double s_m) const {
  const double moved_m = std::max(std::abs(s_m - home_s_m_), std::abs(surface_m_ - home_surface_m_));
  return home_ && moved_m < 2.0 * config_.count_m;
}

bool ContactSpring::return_anchor(double s_m, double dt_s, EnergySource& source) {
  paid_j_ = 0.0;
  const double k = stiffness_n_per_m();
  const double depth = s_m - anchor_m_;
  if (depth < 0.0 || k <= 0.0) {
    anchor_m_ = std::max(s_m, surface_m_);
    return false;
  }
  const double inwards = surface_m_ - anchor_m_;
  if (inwards >= 0.0) {
    anchor_m_ += std::min(-std::expm1(-dt_s / config_.fade_s) * inwards, depth);
    return false;
  }
  if (yielding_ || settled(s_m)) return false;
  home_ = -inwards <= config_.count_m;
  if (home_) {
    home_s_m_ = s_m;
    home_surface_m_ = surface_m_;
    return false;
  }
  // Outwards: k/2 ((d + m)^2 - d^2) = cost. If the available energy is less, this is solved for m without
  // cancellation.
  const double most = config_.force_max_n / k;
  const double full_s = s_m - s_slow_m_ > 2.0 * config_.count_m ? kFullForce_s : kAtRest_s;
  const double grown = (last_n_ + config_.force_max_n * dt_s / full_s) / k;  // depth at the permitted force
  double out = std::min(-std::expm1(-dt_s / kLoad_s) * -inwards, std::min(most, grown) - depth);
  if (out <= 0.0) return false;
  const double cost = 0.5 * k * out * (2.0 * depth + out);
  const double there = source.level_j();
  if (there <= 0.0) return true;
  if (cost > there) out = (2.0 * there / k) / (depth + std::sqrt(depth * depth + 2.0 * there / k));
  paid_j_ = source.spend(0.5 * k * out * (2.0 * depth + out));
  anchor_m_ -= out;
  return cost > there;
}

double ContactSpring::force_n(double s_m) const {
  return stiffness_n_per_m() * std::max(0.0, s_m - anchor_m_);
}

double ContactSpring::energy_j(double s_m) const {
  const double depth = std::max(0.0, s_m - anchor_m_);
  return 0.5 * stiffness_n_per_m() * depth * depth;
}

}  // namespace longreach
