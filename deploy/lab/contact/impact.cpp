// A mass hits a Hunt-Crossley contact and leaves it. Measures the errors of restitution, energy and contact
// time of each integrator, and its cost, as a function of the stiffness of the contact relative to the step,
// kappa = k (v dt)^(n-1) dt²/m. First kappa is varied (n = 1.5, a v = 0.5, the worst of several phases of the
// touch within a step). Then 3000 random impacts have kappa in 1e-6 to 1e6, n in 1 to 3 and a v in 0 to 10.

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/random.hpp"
#include "deploy/lab/contact/free_impact.hpp"
#include "deploy/lab/contact/impact_oracle.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr int kPerDecade = 8;
constexpr int kPhases = 8;
constexpr int kCases = 3000;
constexpr double kRight = 1e-10;    // error of restitution
constexpr double kPlotted = 1e-17;  // smaller values are drawn at this value

// Errors of one impact, or the worst of several.
struct Judged {
  double restitution = 0.0;  // error
  double time = 0.0;         // error of the contact time / contact time
  double rise = 0.0;         // energy error in a step / energy at the touch
  double evaluations = 0.0;
};

FreeImpact impact_of(double kappa, double n, double av, double phase) {
  FreeImpact impact;
  impact.phase = phase;
  impact.contact.law.n = n;
  impact.contact.law.a = av / impact.speed_m_per_s;
  impact.contact.law.k = kappa * impact.contact.mass_kg / (impact.dt * impact.dt) /
                         std::pow(impact.speed_m_per_s * impact.dt, n - 1.0);
  return impact;
}

test::ImpactOracle oracle_of(const FreeImpact& impact) {
  const ContactMass& c = impact.contact;
  return {c.mass_kg, c.law.k, c.law.n, c.law.a, impact.speed_m_per_s};
}

Judged judge(FreeImpact impact, Integrator integrator, double restitution, double time_s) {
  impact.integrator = integrator;
  const FreeImpactOutcome out = run_free_impact(impact);
  if (!out.left) return {1e9, 1e9, 1e9, static_cast<double>(out.evaluations)};
  return {std::abs(out.restitution - restitution), std::abs(out.contact_time_s / time_s - 1.0),
          out.energy_rise, static_cast<double>(out.evaluations)};
}

void keep_worst(Judged& worst, const Judged& one) {
  worst.restitution = std::max({worst.restitution, one.restitution, kPlotted});
  worst.time = std::max(worst.time, one.time);
  worst.rise = std::max({worst.rise, one.rise, kPlotted});
  worst.evaluations = std::max(worst.evaluations, one.evaluations);
}

void sweep(const ExperimentRun& run) {
  Trace trace(run.out, "impact",
              {"kappa", "discrete_gradient_restitution", "discrete_gradient_time", "discrete_gradient_rise",
               "discrete_gradient_evaluations", "explicit_euler_restitution", "explicit_euler_time",
               "explicit_euler_rise", "explicit_euler_evaluations", "semi_implicit_euler_restitution",
               "semi_implicit_euler_time", "semi_implicit_euler_rise", "semi_implicit_euler_evaluations",
               "rk4_restitution", "rk4_time", "rk4_rise", "rk4_evaluations"});
  Random random = Random(run.seed).child("phase");
  for (int i = -6 * kPerDecade; i <= 6 * kPerDecade; ++i) {
    const double kappa = std::pow(10.0, static_cast<double>(i) / kPerDecade);
    const test::ImpactOracle exact = oracle_of(impact_of(kappa, 1.5, 0.5, 0.0));
    const double restitution = static_cast<double>(exact.restitution());
    const double time_s = static_cast<double>(exact.duration());
    std::array<Judged, std::size(kIntegrators)> w{};
    for (std::size_t k = 0; k < w.size(); ++k) {
      for (int p = 0; p < kPhases; ++p) {
        const FreeImpact impact = impact_of(kappa, 1.5, 0.5, random.uniform());
        keep_worst(w[k], judge(impact, kIntegrators[k].integrator, restitution, time_s));
      }
    }
    trace.row({kappa, w[0].restitution, w[0].time, w[0].rise, w[0].evaluations, w[1].restitution, w[1].time,
               w[1].rise, w[1].evaluations, w[2].restitution, w[2].time, w[2].rise, w[2].evaluations,
               w[3].restitution, w[3].time, w[3].rise, w[3].evaluations});
  }
  trace.close();
}

}  // namespace

std::vector<Plot> impact_plots() {
  const auto curves = [](const std::string& what) -> std::vector<Curve> {
    return {{"discrete_gradient" + what, "discrete gradient"},
            {"explicit_euler" + what, "explicit Euler"},
            {"semi_implicit_euler" + what, "semi-implicit Euler"},
            {"rk4" + what, "Runge-Kutta (4th order)"}};
  };
  const std::string axes = "set logscale xy\nset xrange [1e-6:1e6]\nset format y '10^{%L}'\n";
  const std::string drawn = axes + "set yrange [1e-17:1e4]\nset ytics 1e-16,1e4,1e4\n";
  return {{.name = "impact",
           .csv = "impact",
           .title = "Four integrators in a free impact (n = 1.5, a v = 0.5) versus the relative contact "
                    "stiffness",
           .x_column = "kappa",
           .x_label = "stiffness k (v dt)^{n-1} dt^2 / m",
           .panels = {{"restitution error", curves("_restitution"), drawn},
                      {"generated energy", curves("_rise"), drawn},
                      {"contact time error", curves("_time"),
                       axes + "set yrange [1e-8:1e4]\nset ytics 1e-8,1e4,1e4\n"},
                      {"force evaluations", curves("_evaluations"),
                       axes + "set yrange [1:1e5]\nset ytics auto\nset format x '10^{%L}'\n"}}}};
}

std::vector<Metric> run_impact(const ExperimentRun& run) {
  sweep(run);
  std::array<Judged, std::size(kIntegrators)> worst{};
  std::array<int, std::size(kIntegrators)> right{};
  std::array<double, std::size(kIntegrators)> evaluations{};
  Random random = Random(run.seed).child("cases");
  for (int i = 0; i < kCases; ++i) {
    const double kappa = std::pow(10.0, random.uniform(-6.0, 6.0)), n = random.uniform(1.0, 3.0);
    const FreeImpact impact = impact_of(kappa, n, random.uniform(0.0, 10.0), random.uniform());
    const double restitution = static_cast<double>(oracle_of(impact).restitution());
    for (std::size_t k = 0; k < std::size(kIntegrators); ++k) {
      const Judged one = judge(impact, kIntegrators[k].integrator, restitution, 1.0);
      keep_worst(worst[k], one);
      right[k] += one.restitution <= kRight ? 1 : 0;
      evaluations[k] += one.evaluations / kCases;
    }
    if (run.progress) run.progress(static_cast<double>(i + 1) / kCases);
  }
  std::vector<Metric> metrics{{"impacts", kCases, ""}};
  for (std::size_t k = 0; k < std::size(kIntegrators); ++k) {
    const std::string name(kIntegrators[k].name);
    metrics.push_back({name + "_right", 100.0 * right[k] / kCases, "% of the impacts, within 1e-10"});
    metrics.push_back({name + "_error_max", worst[k].restitution, "fraction of the speed"});
    metrics.push_back({name + "_rise_max", worst[k].rise, "fraction of the energy at touch"});
    metrics.push_back({name + "_evaluations", evaluations[k], "mean"});
  }
  return metrics;
}

}  // namespace longreach
