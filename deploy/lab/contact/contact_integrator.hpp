#pragma once
// One step of a mass that moves along the normal of a Hunt-Crossley contact (hunt_crossley.hpp):
//   ẋ = v,   m v̇ = -F(x, v) + external
// In q = ln(1 + a v)/a an impact is a Hamiltonian motion with K(q) = (e^(aq) - 1 - aq)/a² = G(v):
//   ẋ = K'(q),   q̇ = -U'(x)/m
// so the discrete gradient of both (Gonzalez 1996),
//   Δx = dt ΔK/Δq,   Δq = -dt ΔU/Δx/m,
// conserves H = G(v) + U(x)/m exactly for any step and stiffness: restitution is exact, energy never rises,
// the contact never pulls, and touch and separation need not be located. It is one root in Δq, of a function
// that rises with a slope of at least 1. What it does not promise is timing: that takes steps of a fraction
// of the contact time. The external force kicks before and after, half each; its work is reported as it was
// done. Moving out faster than 1/a, the mass feels no contact. The other integrators are here to be compared
// with; they promise nothing.

#include <cstdint>

#include "slave/scene/hunt_crossley.hpp"

namespace longreach {

enum class Integrator : std::uint8_t { kDiscreteGradient, kExplicitEuler, kSemiImplicitEuler, kRk4 };

struct NormalMotion {
  double depth_m = 0.0;        // into the material; negative: away from it
  double speed_m_per_s = 0.0;  // inwards
};

struct NormalStep {
  NormalMotion motion{};         // after the step; as before it if something is not finite
  double external_work_j = 0.0;  // on the mass
  int evaluations = 0;           // of the contact's force
  bool converged = true;         // false: the bound on evaluations was met, or something is not finite
};

struct ContactMass {
  HuntCrossley law{};
  double mass_kg = 1.0;  // > 0
};

/// external_n inwards, constant in the step; dt >= 0, s.
NormalStep step_contact(Integrator integrator, const ContactMass& contact, const NormalMotion& motion,
                        double external_n, double dt);

/// A lower bound of the time that an impact at this speed > 0 lasts, s: exact without damping, three quarters
/// of it for a v = 1, a fifth for a v = 10.
double contact_time_s(const ContactMass& contact, double speed_m_per_s);

}  // namespace longreach
