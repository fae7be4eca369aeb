#pragma once
// A mass that hits a Hunt-Crossley contact and rebounds, simulated by one of the integrators with the step
// dt.

#include <string_view>

#include "deploy/lab/contact/contact_integrator.hpp"

namespace longreach {

struct FreeImpact {
  ContactMass contact{};
  double speed_m_per_s = 0.1;  // impact speed, > 0
  double dt = 1e-3;            // > 0, s
  double phase = 0.0;          // fraction of the first step that precedes the touch, 0 to 1
  Integrator integrator = Integrator::kDiscreteGradient;
};

struct FreeImpactOutcome {
  bool left = false;         // the mass separated; false: there were too many steps, or an overflow
  double restitution = 0.0;  // speed after the impact / speed before the impact
  double penetration_max_m = 0.0;
  double contact_time_s = 0.0;
  double energy_error = 0.0;  // maximum of |H - H0|/H0 over the steps (hunt_crossley.hpp)
  /// Maximum increase of the kinetic plus elastic energy in a step / kinetic energy at the touch.
  double energy_rise = 0.0;
  long evaluations = 0;  // number of evaluations of the contact force
};

constexpr long kFreeImpactSteps = 10'000'000;  // maximum number of steps

FreeImpactOutcome run_free_impact(const FreeImpact& impact);

struct NamedIntegrator {
  std::string_view name;
  Integrator integrator;
};

constexpr NamedIntegrator kIntegrators[] = {{"discrete_gradient", Integrator::kDiscreteGradient},
                                            {"explicit_euler", Integrator::kExplicitEuler},
                                            {"semi_implicit_euler", Integrator::kSemiImplicitEuler},
                                            {"rk4", Integrator::kRk4}};

}  // namespace longreach
