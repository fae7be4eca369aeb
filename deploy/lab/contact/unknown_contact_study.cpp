// Many unknown contacts: of the Hunt-Crossley family, outside it, pressed lightly, and with control settings
// that must give bad results.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/unknown_contact.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kSlope = 0.05, kForce = 0.1, kFar = 0.15, kTangent = 0.15, kLight = 0.1;
constexpr double kStill_m = 1e-4;
constexpr MaterialKind kOutside[] = {MaterialKind::kProgressive, MaterialKind::kLayered,
                                     MaterialKind::kHysteretic};

struct Study {
  std::vector<UnknownCell> cells;
  std::vector<UnknownResult> results;

  template <class Predicate>
  [[nodiscard]] double count(Predicate p) const {
    return static_cast<double>(std::ranges::count_if(results, p));
  }
  template <class Value>
  [[nodiscard]] std::vector<double> sorted(Value value) const {
    std::vector<double> all;
    for (const UnknownResult& r : results) all.push_back(value(r));
    std::ranges::sort(all);
    return all;
  }
};

bool right(const UnknownResult& r) {
  return r.probed && std::abs(r.slope_error) <= kSlope && std::abs(r.force_error) <= kForce;
}
bool covered(const UnknownResult& r) { return r.probed && std::abs(r.estimate_error) <= 3.0 * r.estimate_sd; }

double median(const std::vector<double>& sorted) { return sorted.empty() ? 0.0 : sorted[sorted.size() / 2]; }

/// Within one standard deviation, a third of the claimed range; two thirds of a normal distribution are.
bool within_one_sd(const UnknownResult& r) { return r.probed && std::abs(r.estimate_error) <= r.estimate_sd; }

/// Runs every cell with these settings. The seeds count up from that of the run.
Study study(const ExperimentRun& run, std::vector<UnknownCell> cells, const CellSettings& settings,
            const std::function<void(double)>& progress) {
  Study s{std::move(cells), {}};
  s.results.resize(s.cells.size());
  on_all_cores(
      s.cells.size(),
      [&](std::size_t i) {
        ExperimentRun one;
        one.config = run.config;
        one.seed = run.seed + i;
        s.results[i] = run_cell(one, s.cells[i], settings);
      },
      progress);
  return s;
}

void write(Trace& trace, double group, const Study& s) {
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const UnknownCell& c = s.cells[i];
    const UnknownResult& r = s.results[i];
    trace.row({group,
               static_cast<double>(c.kind),
               c.grip == Grip::kFirm ? 1.0 : 0.0,
               c.slope_n_per_m,
               c.n,
               c.damping_s_per_m,
               c.scale,
               c.noise_n,
               c.tool_n,
               c.probe_share,
               r.rtt_s,
               r.slope_error,
               r.force_error,
               r.reported_error,
               r.reported_sd,
               r.estimate_error,
               r.estimate_sd,
               r.estimate_sd > 0.0 ? r.estimate_error / r.estimate_sd : 0.0,
               r.bound_sd,
               r.first_s,
               r.fixed_first_s,
               r.bound_first_s,
               r.power_law ? 1.0 : 0.0,
               static_cast<double>(r.contacts),
               static_cast<double>(r.presses),
               r.ripple_m,
               r.returned_j});
  }
}

void write(const ExperimentRun& run, const Study& in, const Study& out, const Study& soft) {
  Trace trace(run.out, "cells", {"group",          "kind",        "firm",
                                 "slope_n_per_m",  "n",           "damping_s_per_m",
                                 "scale",          "noise_n",     "tool_n",
                                 "probe_share",    "rtt_s",       "slope_error",
                                 "force_error",    "told_error",  "told_sd",
                                 "estimate_error", "estimate_sd", "estimate_error_over_sd",
                                 "bound_sd",       "first_s",     "fixed_first_s",
                                 "bound_first_s",  "power_law",   "contacts",
                                 "presses",        "ripple_m",    "returned_j"});
  write(trace, 0.0, in);
  write(trace, 1.0, out);
  write(trace, 2.0, soft);
  trace.close();
}

double worst(const Study& s, double UnknownResult::*value) {
  double most = 0.0;
  for (const UnknownResult& r : s.results) most = std::max(most, std::abs(r.*value));
  return most;
}

double over(double a, double b) { return b > 0.0 ? a / b : 0.0; }

std::vector<Metric> of_family(const Study& in) {
  return {
      {"cells", static_cast<double>(in.cells.size()), ""},
      {"right", in.count(right), ""},
      {"slope_error_max", worst(in, &UnknownResult::slope_error), ""},
      {"force_error_max", worst(in, &UnknownResult::force_error), ""},
      {"beyond_15_percent", in.count([](const UnknownResult& r) {
         return !r.probed || std::max(std::abs(r.slope_error), std::abs(r.force_error)) > kFar;
       }),
       ""},
      {"returned_max_j", worst(in, &UnknownResult::returned_j), "J"},
      {"limit_cycles", in.count([](const UnknownResult& r) { return r.ripple_m > kStill_m; }), ""},
      {"covered", in.count(covered), ""},
      {"sd_over_bound_median",
       median(in.sorted([](const UnknownResult& r) { return over(r.estimate_sd, r.bound_sd); })), ""},
      {"first_over_bound_max",
       in.sorted([](const UnknownResult& r) { return over(r.first_s, r.bound_first_s); }).back(), ""},
      {"first_over_fixed_median",
       median(in.sorted([](const UnknownResult& r) { return over(r.first_s, r.fixed_first_s); })), ""},
      {"family_without_law", in.count([](const UnknownResult& r) { return !r.power_law; }), ""},
  };
}

std::vector<Metric> of_others(const Study& in, const Study& out, const Study& soft, const Study& assumed,
                              const Study& usual, const Study& noisy) {
  return {
      {"outside_cells", static_cast<double>(out.cells.size()), ""},
      {"outside_tangent_within_15_percent",
       out.count([](const UnknownResult& r) { return r.probed && std::abs(r.reported_error) <= kTangent; }),
       ""},
      {"outside_without_law", out.count([](const UnknownResult& r) { return !r.power_law; }), ""},
      {"light_cells", static_cast<double>(soft.cells.size()), ""},
      {"light_right", soft.count([](const UnknownResult& r) {
         return r.probed && std::max(std::abs(r.slope_error), std::abs(r.force_error)) <= kLight;
       }),
       ""},
      {"light_one_contact_a_press",
       soft.count([](const UnknownResult& r) { return r.contacts == r.presses; }), ""},
      {"control_cells", static_cast<double>(assumed.cells.size()), ""},
      {"control_assumed_exponent_right", assumed.count(right), ""},
      {"control_usual_force_right", usual.count(right), ""},
      {"control_a_third_of_sd_covered", in.count(within_one_sd), ""},
      {"untold_noise_covered", noisy.count(covered), ""},
  };
}

}  // namespace

std::vector<Plot> unknown_contact_plots() {
  return {{.name = "unknown_contact",
           .csv = "cells",
           .title = "Random materials: errors of the displayed contact",
           .x_column = "slope_n_per_m",
           .x_label = "tangent stiffness of the material at the working depth (N/m)",
           .panels = {{"tangent stiffness error (%)",
                       {{.column = "slope_error", .title = "run", .factor = 100.0, .points = true}},
                       "set logscale x\nset yrange [-15:15]"},
                      {"mean force error (%)",
                       {{.column = "force_error", .title = "run", .factor = 100.0, .points = true}},
                       "set logscale x\nset yrange [-15:15]"},
                      {"estimation error / estimated sd",
                       {{.column = "estimate_error_over_sd", .title = "run", .points = true}},
                       "set logscale x\nset yrange [-4:4]"}}}};
}

std::vector<Metric> run_unknown_contact(const ExperimentRun& run) {
  const auto cells = static_cast<std::size_t>(campaign(2000, 200));
  const std::size_t others = cells / 5, controls = cells / 5;
  std::vector<UnknownCell> family, outside, light;
  const Random random = Random(run.seed).child("unknown-contact");
  Random drawn = random.child("family");
  for (std::size_t i = 0; i < cells; ++i) family.push_back(draw_cell(drawn, MaterialKind::kHuntCrossley));
  drawn = random.child("outside");
  for (std::size_t i = 0; i < others; ++i)
    outside.push_back(draw_cell(drawn, kOutside[i % std::size(kOutside)]));
  drawn = random.child("light");
  for (std::size_t i = 0; i < 12; ++i) light.push_back(draw_light_cell(drawn, i));
  const std::vector<UnknownCell> few(family.begin(), family.begin() + static_cast<std::ptrdiff_t>(controls));

  const double runs = static_cast<double>(cells + others + light.size() + 3 * controls);
  double done = 0.0;
  const auto group = [&](std::vector<UnknownCell> which, const CellSettings& settings) {
    const double share = static_cast<double>(which.size()) / runs;
    Study s = study(run, std::move(which), settings, [&](double part) {
      if (run.progress) run.progress(std::min(1.0, done + part * share));
    });
    done += share;
    return s;
  };
  const Study in = group(family, {.fixed_too = true}), out = group(outside, {}), soft = group(light, {});
  const Study assumed = group(few, {.assumed_exponent = 2.0}), usual = group(few, {.never_follows = true}),
              noisy = group(few, {.noise_unreported = 2.0});

  write(run, in, out, soft);
  std::vector<Metric> metrics = of_family(in);
  for (Metric& m : of_others(in, out, soft, assumed, usual, noisy)) metrics.push_back(std::move(m));
  return metrics;
}

}  // namespace longreach
