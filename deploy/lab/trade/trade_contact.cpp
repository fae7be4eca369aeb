// A free impact (n 1.5, a v 0.5, 1e6 N/m^1.5, 1 kg, 0.1 m/s; it lasts 3 ms): integrators with different
// steps, and one whose steps start and end exactly at touch and separation.

#include <cmath>

#include "common/core/random.hpp"
#include "deploy/lab/contact/free_impact.hpp"
#include "deploy/lab/contact/impact_oracle.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {
namespace {

constexpr double kSteps_s[] = {2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5};
constexpr double kStandard_s = 1e-3;
constexpr int kPhases = 16;
constexpr int kLocatedSteps[] = {4, 8, 16, 32, 64, 128};

FreeImpact impact() {
  FreeImpact i;
  i.contact.law = {1e6, 1.5, 5.0};
  return i;
}

struct State {
  double x, v;
};

State derivative(const ContactMass& c, State s) { return {s.v, -c.law.force_n(s.x, s.v) / c.mass_kg}; }

State runge_kutta(const ContactMass& c, State s, double h) {
  const State a = derivative(c, s), b = derivative(c, {s.x + 0.5 * h * a.x, s.v + 0.5 * h * a.v}),
              d = derivative(c, {s.x + 0.5 * h * b.x, s.v + 0.5 * h * b.v}),
              e = derivative(c, {s.x + h * d.x, s.v + h * d.v});
  return {s.x + h / 6.0 * (a.x + 2.0 * b.x + 2.0 * d.x + e.x),
          s.v + h / 6.0 * (a.v + 2.0 * b.v + 2.0 * d.v + e.v)};
}

/// Restitution by Runge-Kutta from the touch on; the last step is shortened until it ends at the surface.
double located(const FreeImpact& i, int steps) {
  const double h = 2.0 * contact_time_s(i.contact, i.speed_m_per_s) / steps;
  State s{0.0, i.speed_m_per_s};
  for (int n = 0; n < 100 * steps; ++n) {
    const State next = runge_kutta(i.contact, s, h);
    if (next.x > 0.0) {
      s = next;
      continue;
    }
    double low = 0.0, high = h;
    for (int bisection = 0; bisection < 50; ++bisection) {
      const double middle = 0.5 * (low + high);
      (runge_kutta(i.contact, s, middle).x > 0.0 ? low : high) = middle;
    }
    return -runge_kutta(i.contact, s, low).v / i.speed_m_per_s;
  }
  return 0.0;
}

TradePoint of_step(NamedIntegrator which, double dt, double exact, Random random) {
  std::vector<FreeImpact> impacts(kPhases, impact());
  TradePoint point{std::string(which.name), std::to_string(std::lround(1e6 * dt)) + "us"};
  point.standard = which.integrator == Integrator::kDiscreteGradient && dt == kStandard_s;
  for (FreeImpact& i : impacts) {
    i.integrator = which.integrator;
    i.dt = dt;
    i.phase = random.uniform();
    const FreeImpactOutcome out = run_free_impact(i);
    point.error = std::max(point.error, out.left ? std::abs(out.restitution - exact) : 1.0);
  }
  const auto call = [&](int i) { run_free_impact(impacts[static_cast<std::size_t>(i)]); };
  point.cost = cost_ns(kPhases, call);
  return point;
}

std::vector<TradePoint> measure_contact(const ExperimentRun& run) {
  const FreeImpact base = impact();
  const ContactMass& c = base.contact;
  const test::ImpactOracle oracle{c.mass_kg, c.law.k, c.law.n, c.law.a, base.speed_m_per_s};
  const auto exact = static_cast<double>(oracle.restitution());
  const Random random = Random(run.seed).child("trade contact");
  std::vector<TradePoint> points;
  for (const NamedIntegrator& which : kIntegrators) {
    for (const double dt : kSteps_s) points.push_back(of_step(which, dt, exact, random));
  }
  for (const int steps : kLocatedSteps) {
    TradePoint point{"event_located", std::to_string(steps) + "steps"};
    point.error = std::abs(located(base, steps) - exact);
    double sum = 0.0;
    point.cost = cost_ns(kPhases, [&](int) { sum += located(base, steps); });
    if (!std::isfinite(sum)) point.error = 1.0;
    points.push_back(point);
  }
  return points;
}

}  // namespace

TradeStage trade_contact() {
  return {.name = "contact",
          .title = "Integrators for a free impact of 3 ms, with steps of 2 ms to 10 µs",
          .cost = "computing time per impact",
          .cost_unit = "ns",
          .error = "restitution error",
          .error_unit = "fraction of the speed",
          .series = {"discrete_gradient", "explicit_euler", "semi_implicit_euler", "rk4", "event_located"},
          .measure = measure_contact};
}

}  // namespace longreach
