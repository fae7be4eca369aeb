#include "master/rendering/contact_spring.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kFullForce_s = 0.4;

}  // namespace

void ContactSpring::begin(double s_m, double surface_m) {
  target_ = fading_ = 0.0;
  clamped_ = yielding_ = leaving_ = false;
  surface_m_ = surface_m;
  anchor_m_ = std::max(s_m, surface_m);
  s_slow_m_ = s_m;
}

bool ContactSpring::set_stiffness(double s_m, double stiffness_n_per_m) {
  if (!std::isfinite(stiffness_n_per_m)) return false;
  const double wanted = std::clamp(stiffness_n_per_m, 0.0, config_.stiffness_max_n_per_m);
  clamped_ = wanted < stiffness_n_per_m;
  const double present = this->stiffness_n_per_m();
  if (wanted > present) {
    // Same force from less energy: f^2/2k falls with k.
    const double depth = std::max(0.0, s_m - anchor_m_);
    if (depth > 0.0) anchor_m_ = s_m - depth * (present / wanted);
    fading_ = 0.0;
  } else {
    fading_ = present - wanted;
  }
  target_ = wanted;
  return true;
}

bool ContactSpring::set_surface(double surface_m, bool comes_along) {
  if (!std::isfinite(surface_m)) return false;
  comes_along_ = comes_along;
  surface_m_ = surface_m;
  return true;
}

double ContactSpring::step(double s_m, double dt_s, EnergyTank& tank) {
  if (fading_ > 0.0) fading_ *= std::exp(-dt_s / config_.fade_s);
  if (fading_ < 1e-9 * config_.stiffness_max_n_per_m) fading_ = 0.0;
  const double k = stiffness_n_per_m();
  yielding_ = k * (s_m - anchor_m_) > config_.force_max_n;
  if (yielding_) anchor_m_ = s_m - config_.force_max_n / k;
  return_anchor(s_m, dt_s, tank);
  s_slow_m_ -= std::expm1(-dt_s / config_.fade_s) * (s_m - s_slow_m_);
  return force_n(s_m);
}

void ContactSpring::return_anchor(double s_m, double dt_s, EnergyTank& tank) {
  paid_j_ = 0.0;
  const double k = stiffness_n_per_m();
  const double depth = s_m - anchor_m_;
  if (depth <= 0.0 || k <= 0.0) {
    anchor_m_ = std::max(s_m, surface_m_);
    return;
  }
  const double share = -std::expm1(-dt_s / config_.fade_s);
  const double move = share * (surface_m_ - anchor_m_);
  if (move >= 0.0) {
    anchor_m_ += std::min(move, depth);
    return;
  }
  if (yielding_) return;
  // Outwards: k/2 ((d + m)^2 - d^2) = cost; solved for m where the tank is short, without cancellation.
  const double most = config_.force_max_n / k;
  // A wall that was learnt late, far behind: it grows; a hand that leaves it goes free.
  const double fastest = most * dt_s / kFullForce_s;
  // Where it comes along, easing would let the hand back in, to be pushed out again.
  leaving_ = !comes_along_ && s_m < s_slow_m_ && (leaving_ || -move > fastest);
  if (leaving_) {
    anchor_m_ += share * depth;
    return;
  }
  double out = std::min({-move, std::max(0.0, most - depth), fastest});
  const double cost = 0.5 * k * out * (2.0 * depth + out);
  const double there = tank.level_j();
  if (cost > there) out = (2.0 * there / k) / (depth + std::sqrt(depth * depth + 2.0 * there / k));
  paid_j_ = tank.spend(0.5 * k * out * (2.0 * depth + out));
  anchor_m_ -= out;
}

double ContactSpring::force_n(double s_m) const {
  return stiffness_n_per_m() * std::max(0.0, s_m - anchor_m_);
}

double ContactSpring::energy_j(double s_m) const {
  const double depth = std::max(0.0, s_m - anchor_m_);
  return 0.5 * stiffness_n_per_m() * depth * depth;
}

}  // namespace longreach
