#pragma once
// Integrates the motion of a mass along the normal of a Hunt-Crossley contact by one step
// (hunt_crossley.hpp):
//   ẋ = v,   m v̇ = -F(x, v) + external
// With q = ln(1 + a v)/a, an impact is a Hamiltonian motion with K(q) = (e^(aq) - 1 - aq)/a² = G(v):
//   ẋ = K'(q),   q̇ = -U'(x)/m
// so the discrete gradients of K and U (Gonzalez 1996),
//   Δx = dt ΔK/Δq,   Δq = -dt ΔU/Δx/m,
// conserve H = G(v) + U(x)/m exactly for any step size and stiffness: the restitution is exact, the energy
// never rises, the contact never pulls, and the instants of touch and separation need not be located. Each step
// finds the root in Δq of a function with a slope of at least 1. The timing is not exact; for accurate timing,
// the step must be much shorter than the contact time. Half of the external impulse is applied before the step
// and half after it; the result includes the work of the impulse. If the mass moves outwards faster than 1/a,
// there is no contact force. The other integrators serve only for comparison and have none of these properties.

#include <cstdint>

#include "slave/simulation/scene/hunt_crossley.hpp"

namespace longreach {

enum class Integrator : std::uint8_t { kDiscreteGradient, kExplicitEuler, kSemiImplicitEuler, kRk4 };

struct NormalMotion {
  double depth_m = 0.0;        // penetration into the material; negative: outside
  double speed_m_per_s = 0.0;  // positive inwards
};

struct NormalStep {
  NormalMotion motion{};         // state after the step; unchanged if a value is not finite
  double external_work_j = 0.0;  // work of the external force on the mass
  int evaluations = 0;           // number of evaluations of the contact force
  bool converged = true;  // false: the maximum number of evaluations was reached, or a value is not finite
};

struct ContactMass {
  HuntCrossley law{};
  double mass_kg = 1.0;  // > 0
};

/// The external force external_n is positive inwards and constant during the step; dt is in s, >= 0.
NormalStep step_contact(Integrator integrator, const ContactMass& contact, const NormalMotion& motion,
                        double external_n, double dt);

/// Returns a lower bound of the duration of an impact, s, for a speed > 0. The bound is exact without
/// damping; it is three quarters of the true duration for a v = 1, and a fifth for a v = 10.
double contact_time_s(const ContactMass& contact, double speed_m_per_s);

}  // namespace longreach
