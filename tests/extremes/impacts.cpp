// A mass that meets a contact: the slave's contact integrator against the integrals of the impact.

#include <cmath>
#include <limits>

#include "common/core/random.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/contact/free_impact.hpp"
#include "deploy/lab/contact/impact_oracle.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kRestitution = 1e-10;
constexpr double kRise = 1e-12;  // of energy in a step, over that at touch
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

/// So damped that it creeps out for longer than anybody waits: slower than the exact speed of leaving.
ExtremeResult creep(const FreeImpact& what, double restitution) {
  constexpr int kSteps = 10000;
  const ContactMass& c = what.contact;
  NormalMotion at{0.0, what.speed_m_per_s};
  const auto energy_j = [&c](const NormalMotion& m) {
    return 0.5 * c.mass_kg * m.speed_m_per_s * m.speed_m_per_s + c.law.energy_j(m.depth_m);
  };
  const double touch_j = energy_j(at);
  for (int i = 0; i < kSteps; ++i) {
    const NormalStep step = step_contact(what.integrator, c, at, 0.0, what.dt);
    if (!step.converged) return bad("the step does not converge");
    if (!(energy_j(step.motion) - energy_j(at) <= kRise * touch_j)) return bad("energy rises");
    at = step.motion;
  }
  return accurate(std::abs(-at.speed_m_per_s / what.speed_m_per_s - restitution), kRestitution);
}

ExtremeResult impact(FreeImpact what, std::uint64_t seed) {
  what.phase = Random(seed).child("extremes").uniform();
  const ContactMass& c = what.contact;
  const test::ImpactOracle exact{c.mass_kg, c.law.k, c.law.n, c.law.a, what.speed_m_per_s};
  const auto restitution = static_cast<double>(exact.restitution());
  if (c.law.a * what.speed_m_per_s > 1e6) return creep(what, restitution);
  const FreeImpactOutcome out = run_free_impact(what);
  if (!out.left) return bad("it never leaves the contact");
  if (!(out.energy_rise <= kRise)) return bad("energy rises by " + format_number(out.energy_rise));
  return accurate(std::abs(out.restitution - restitution), kRestitution);
}

template <class Set>
ExtremeRow impact_row(const std::string& quantity, const std::string& unit,
                      std::initializer_list<double> values, const Set& set) {
  const auto cell = [&set](const std::string& name, double value, Integrator integrator) {
    return ExtremeCell{name, "", [set, value, integrator](std::uint64_t seed) {
                         FreeImpact what{.integrator = integrator};
                         what.contact.law = {1e4, 1.5, 0.5};
                         set(what, value);
                         return impact(what, seed);
                       }};
  };
  ExtremeRow row{"impact: " + quantity,
                 "error of the restitution",
                 cell("semi-implicit Euler", *values.begin(), Integrator::kSemiImplicitEuler),
                 {}};
  for (const double value : values)
    row.cells.push_back(cell(short_text(value) + unit, value, Integrator::kDiscreteGradient));
  return row;
}

/// What no contact has: the mass stays as it is, and the step says so.
ExtremeCell impossible(const std::string& name, const ContactMass& contact, const NormalMotion& at,
                       double dt) {
  return {name, "converged = false", [=](std::uint64_t) {
            const NormalStep step = step_contact(Integrator::kDiscreteGradient, contact, at, 0.0, dt);
            const bool finite = std::isfinite(step.motion.speed_m_per_s) || !std::isfinite(at.speed_m_per_s);
            if (!finite || !std::isfinite(step.external_work_j)) return bad("not finite");
            return step.converged ? bad("taken as if it could be") : refused("converged = false");
          }};
}

}  // namespace

std::vector<ExtremeRow> extreme_impacts() {
  std::vector<ExtremeRow> rows;
  for (const double n : {1.0, 1.5, 2.0, 3.0}) {
    rows.push_back(impact_row("stiffness, n = " + format_number(n), "", {1e0, 1e2, 1e3, 1e5, 1e7, 1e9},
                              [n](FreeImpact& what, double k) {
                                what.contact.law.k = k;
                                what.contact.law.n = n;
                              }));
  }
  rows.push_back(impact_row("damping λ/k", "", {0.0, kDenormal, 1e-12, 1.0, 1e3, 1e6, 1e12, 1e100},
                            [](FreeImpact& what, double a) { what.contact.law.a = a; }));
  rows.push_back(impact_row("mass", " kg", {1e-3, 1.0, 1e3, 1e5},
                            [](FreeImpact& what, double m) { what.contact.mass_kg = m; }));
  rows.push_back(
      impact_row("sample time", " s", {2e-5, 1e-3, 5e-2}, [](FreeImpact& what, double dt) { what.dt = dt; }));
  rows.push_back(impact_row("speed", " m/s", {1e-9, 1e-3, 1.0, 1e3},
                            [](FreeImpact& what, double v) { what.speed_m_per_s = v; }));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  rows.push_back(
      {"impact: what cannot be",
       "the motion stays finite",
       impossible("what can be", {}, {1e-3, 0.1}, 1e-3),
       {impossible("depth NaN", {}, {nan, 0.1}, 1e-3), impossible("speed inf", {}, {1e-3, inf}, 1e-3),
        impossible("k NaN", {{nan, 1.0, 0.1}, 1.0}, {1e-3, 0.1}, 1e-3),
        impossible("mass 0", {{1e3, 1.0, 0.1}, 0.0}, {1e-3, 0.1}, 1e-3),
        impossible("dt NaN", {}, {1e-3, 0.1}, nan)}});
  return rows;
}

}  // namespace longreach
