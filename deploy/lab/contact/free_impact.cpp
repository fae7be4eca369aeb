#include "deploy/lab/contact/free_impact.hpp"

#include <algorithm>

namespace longreach {
namespace {

// Returns H, or the energy if H is not defined because the mass leaves faster than 1/a.
double invariant(const ContactMass& contact, const NormalMotion& at) {
  const double v = at.speed_m_per_s, elastic = contact.law.energy_j(at.depth_m) / contact.mass_kg;
  return (1.0 + contact.law.a * v > 0.0 ? contact.law.impact_energy(v) : 0.5 * v * v) + elastic;
}

double energy(const ContactMass& contact, const NormalMotion& at) {
  return 0.5 * at.speed_m_per_s * at.speed_m_per_s + contact.law.energy_j(at.depth_m) / contact.mass_kg;
}

}  // namespace

FreeImpactOutcome run_free_impact(const FreeImpact& impact) {
  const ContactMass& contact = impact.contact;
  const double touched = impact.speed_m_per_s;
  NormalMotion now{-impact.phase * touched * impact.dt, touched};
  const double invariant_at_touch = invariant(contact, now);
  FreeImpactOutcome out;
  for (long n = 0; n < kFreeImpactSteps && !out.left; ++n) {
    const NormalStep step = step_contact(impact.integrator, contact, now, 0.0, impact.dt);
    out.evaluations += step.evaluations;
    if (!step.converged) return out;
    const NormalMotion next = step.motion;
    const double h = invariant(contact, next);
    out.energy_error = std::max(out.energy_error, std::abs(h / invariant_at_touch - 1.0));
    out.energy_rise =
        std::max(out.energy_rise, (energy(contact, next) - energy(contact, now)) / (0.5 * touched * touched));
    out.penetration_max_m = std::max(out.penetration_max_m, next.depth_m);
    // The maximum depth between two steps follows from the energy, which the step conserves.
    if (impact.integrator == Integrator::kDiscreteGradient && now.speed_m_per_s > 0.0 &&
        next.speed_m_per_s <= 0.0) {
      const double n1 = contact.law.n + 1.0;
      out.penetration_max_m =
          std::max(out.penetration_max_m, std::pow(n1 * contact.mass_kg / contact.law.k * h, 1.0 / n1));
    }
    out.left = next.depth_m <= 0.0 && next.speed_m_per_s < 0.0;
    const double share = out.left ? std::max(now.depth_m, 0.0) / (now.depth_m - next.depth_m) : 1.0;
    out.contact_time_s = (static_cast<double>(n) + share - impact.phase) * impact.dt;
    now = next;
  }
  out.restitution = -now.speed_m_per_s / touched;
  return out;
}

}  // namespace longreach
