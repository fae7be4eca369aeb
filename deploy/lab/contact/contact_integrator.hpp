#pragma once
// One step of a mass that moves along the normal of a Hunt-Crossley contact (hunt_crossley.hpp):
//   ẋ = v,   m v̇ = -F(x, v) + external
// In q = ln(1 + a v)/a an impact is a Hamiltonian motion with K(q) = (e^(aq) - 1 - aq)/a² = G(v):
//   ẋ = K'(q),   q̇ = -U'(x)/m
// so the discrete gradient of both (Gonzalez 1996),
//   Δx = dt ΔK/Δq,   Δq = -dt ΔU/Δx/m,
// conserves H = G(v) + U(x)/m exactly for any step and stiffness: restitution is exact, energy never rises,
// the contact never pulls, and touch and separation need not be located. It requires one root in Δq, of a
// function with a slope of at least 1. Timing is not exact: it requires steps of a fraction of the contact
// time. Half of the external impulse is applied before and half after; its work is reported. When the mass
// moves out faster than 1/a, there is no contact force. The other integrators are for comparison and have
// none of these properties.

#include <cstdint>

#include "slave/scene/hunt_crossley.hpp"

namespace longreach {

enum class Integrator : std::uint8_t { kDiscreteGradient, kExplicitEuler, kSemiImplicitEuler, kRk4 };

struct NormalMotion {
  double depth_m = 0.0;        // into the material; negative: outside
  double speed_m_per_s = 0.0;  // inwards
};

struct NormalStep {
  NormalMotion motion{};         // after the step; unchanged if a value is not finite
  double external_work_j = 0.0;  // on the mass
  int evaluations = 0;           // evaluations of the contact force
  bool converged = true;  // false: the maximum number of evaluations was reached, or a value is not finite
};

struct ContactMass {
  HuntCrossley law{};
  double mass_kg = 1.0;  // > 0
};

/// external_n acts inwards, constant in the step; dt >= 0, s.
NormalStep step_contact(Integrator integrator, const ContactMass& contact, const NormalMotion& motion,
                        double external_n, double dt);

/// A lower bound of the duration of an impact at this speed > 0, s: exact without damping, three quarters of
/// it for a v = 1, a fifth for a v = 10.
double contact_time_s(const ContactMass& contact, double speed_m_per_s);

}  // namespace longreach
