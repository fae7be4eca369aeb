// The experiment `synthesis`: compares the search methods, and reports and plots the best design.

#include <algorithm>
#include <cmath>
#include <string>

#include "deploy/lab/devices/delta_catalog.hpp"
#include "deploy/lab/synthesis/synthesis_study.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

using Comparison = std::vector<std::vector<SearchLog>>;  // in the order of kMethods

double median(const std::vector<double>& sorted) {
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

void add_method(std::vector<Metric>& metrics, const std::string& name, const std::vector<SearchLog>& logs) {
  const std::vector<double> values = values_after(logs, 1 << 30);
  double feasible = 0.0, violation = 0.0;
  std::vector<double> evaluations;
  for (const SearchLog& log : logs) {
    feasible += log.feasible() ? 1.0 : 0.0;
    evaluations.push_back(log.evaluations());
    if (log.feasible()) violation = std::max(violation, log.violation());
  }
  std::sort(evaluations.begin(), evaluations.end());
  metrics.insert(metrics.end(), {{name + "_best", values.back(), ""},
                                 {name + "_median", median(values), ""},
                                 {name + "_worst", values.front(), ""},
                                 {name + "_feasible_share", feasible / static_cast<double>(logs.size()), ""},
                                 {name + "_violation_max", violation, ""},
                                 {name + "_evaluations", median(evaluations), ""}});
}

/// Metrics of `log`, as found on the positions of the search and evaluated on a grid of 31 positions per
/// edge.
void add_design(std::vector<Metric>& metrics, const std::string& name, const SearchLog& log) {
  if (!log.feasible()) {
    metrics.push_back({name + "_feasible", 0.0, ""});
    return;
  }
  const SynthesisDesign d = log.problem().dimensions(log.best());
  const DeltaCubeFigures f = figures(geometry(d), synthesis_demand(), cube(d), 31);
  metrics.insert(metrics.end(), {{name + "_feasible", 1.0, ""},
                                 {name + "_a_m", d.a_m, "m"},
                                 {name + "_l1_m", d.l1_m, "m"},
                                 {name + "_l2_m", d.l2_m, "m"},
                                 {name + "_depth_m", d.depth_m, "m"},
                                 {name + "_side_m", d.side_m, "m"},
                                 {name + "_conditioning", f.conditioning, ""},
                                 {name + "_conditioning_mean", f.conditioning_mean, ""},
                                 {name + "_slack", f.slack, ""},
                                 {name + "_torque_m", f.torque_m, "N m/N"},
                                 {name + "_radius_m", f.radius_m, "m"},
                                 {name + "_height_m", f.height_m, "m"}});
}

void trace_progress(const ExperimentRun& run, const Comparison& all, int budget) {
  Trace trace(run.out, "synthesis_progress",
              {"evaluations", "genetic_low", "genetic_median", "genetic_high", "sequential_low",
               "sequential_median", "sequential_high", "restarted_low", "restarted_median", "restarted_high",
               "genetic_sequential_low", "genetic_sequential_median", "genetic_sequential_high"});
  for (double at = 10.0; at < 1.02 * budget; at *= 1.02) {
    const int evaluations = std::min(static_cast<int>(at), budget);
    std::array<double, 12> c{};
    for (std::size_t m = 0; m < all.size(); ++m) {
      const std::vector<double> values = values_after(all[m], evaluations);
      c[3 * m] = values.front();
      c[3 * m + 1] = median(values);
      c[3 * m + 2] = values.back();
    }
    trace.row({static_cast<double>(evaluations), c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9],
               c[10], c[11]});
  }
  trace.close();
}

/// Conditioning over the side of the largest cube that is possible with it, for new designs and for that of
/// the catalog.
void trace_front(const ExperimentRun& run, const SearchLog& a, const DeltaGeometry& catalog, int budget) {
  Trace trace(run.out, "synthesis_front", {"side_mm", "designed", "catalog"});
  SearchLog::Variables start = a.best();
  for (double side_mm = 30.0; side_mm <= 80.0; side_mm += 2.5) {
    const SearchLog log = search_side(1e-3 * side_mm, start, run.seed, budget);
    if (log.feasible()) start = log.best();
    const CatalogFit fit = best_depth(catalog, synthesis_demand(), 1e-3 * side_mm);
    trace.row({side_mm, log.feasible() ? log.value() : NAN, fit.conditioning > 0.0 ? fit.conditioning : NAN});
  }
  trace.close();
}

/// The plane y = 0: conditioning of both devices, and their cubes.
void trace_slice(const ExperimentRun& run, const SynthesisDesign& d, const DeltaGeometry& catalog,
                 double catalog_depth_m) {
  const DeltaGeometry designed = geometry(d);
  const auto conditioning = [](const DeltaGeometry& g, const Vector3& p_m) {
    const DeltaFigures at = figures(g, p_m);
    return at.conditioning > 0.0 ? at.conditioning : NAN;
  };
  Trace slice(run.out, "synthesis_slice", {"x_mm", "z_mm", "designed", "catalog"});
  for (double z_mm = -150.0; z_mm <= 0.0; z_mm += 1.5) {
    for (double x_mm = -75.0; x_mm <= 75.0; x_mm += 1.5) {
      const Vector3 p_m = 1e-3 * Vector3(x_mm, 0.0, z_mm);
      slice.row({x_mm, z_mm, conditioning(designed, p_m), conditioning(catalog, p_m)});
    }
  }
  slice.close();
  Trace cubes(run.out, "synthesis_cubes", {"x_mm", "designed_z_mm", "catalog_z_mm"});
  const double half_mm = 500.0 * d.side_m;
  for (const auto& [x, z] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    cubes.row({x * half_mm, z * half_mm - 1e3 * d.depth_m, z * half_mm - 1e3 * catalog_depth_m});
  }
  cubes.close();
}

Panel progress_panel(const std::string& name, const std::string& title) {
  return {"conditioning",
          {{name + "_median", title}},
          "set logscale x\nset xrange [10:*]\nset autoscale xfixmax\nset yrange [0:0.6]\nset ytics 0.2\n"
          "plot 'synthesis_progress.csv' using 'evaluations':'" +
              name + "_low':'" + name + "_high' with filledcurves fc rgb '#cfe3f1' notitle"};
}

Panel slice_panel(const std::string& name, const std::string& title, double left) {
  const std::string margins = "set lmargin at screen " + std::to_string(left) + "\nset rmargin at screen " +
                              std::to_string(left + 0.36) +
                              "\nset tmargin at screen 0.82\nset bmargin at screen 0.138\n";
  return {
      "z (mm)",
      {{name + "_z_mm", title}},
      margins +
          "set format x '%g'\nset xlabel 'x (mm)'\nset xrange [-75:75]\nset yrange [-150:0]\n"
          "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#fde725')\n"
          "set cbrange [0:1]\nset cblabel 'conditioning'\nset key at screen " +
          std::to_string(left + 0.36) + ",0.87 horizontal\n" +
          (left < 0.3 ? "unset colorbox\n" : "set colorbox user origin 0.91,0.138 size 0.018,0.682\n") +
          "plot 'synthesis_slice.csv' using 'x_mm':'z_mm':'" + name +
          "' with image notitle, 'synthesis_cubes.csv' using 'x_mm':'" + name +
          "_z_mm' with lines lw 5 lc rgb '#ffffff' notitle"};
}

}  // namespace

std::vector<Plot> synthesis_plots() {
  return {{.name = "synthesis_progress",
           .csv = "synthesis_progress",
           .title = "Worst conditioning in a 60 mm cube for the best design so far (median and range over "
                    "the seeds)",
           .x_column = "evaluations",
           .x_label = "evaluated designs",
           .panels = {progress_panel("genetic", "genetic"), progress_panel("sequential", "SQP, one start"),
                      progress_panel("restarted", "SQP, restarts"),
                      progress_panel("genetic_sequential", "genetic + SQP")}},
          {.name = "synthesis_front",
           .csv = "synthesis_front",
           .title = "Worst conditioning in larger cubes within the same envelope",
           .x_column = "side_mm",
           .x_label = "side of the cube (mm)",
           .panels = {{"worst conditioning",
                       {{"designed", "designed for the cube"}, {"catalog", "catalog device"}},
                       "set yrange [0:1]"}}},
          {.name = "synthesis_slice",
           .csv = "synthesis_cubes",
           .title = "Conditioning in the plane y = 0, with the outline of the cube",
           .x_column = "x_mm",
           .x_label = "x (mm)",
           .panels = {slice_panel("designed", "designed", 0.08),
                      slice_panel("catalog", "catalog (reconstructed)", 0.53)}}};
}

std::vector<Metric> synthesise(const ExperimentRun& run, const SynthesisSize& size) {
  const int parts = static_cast<int>(std::size(kMethods)) * size.seeds;
  int done = 0;
  const auto each_done = [&] {
    if (run.progress) run.progress(static_cast<double>(++done) / (1.1 * parts));
  };
  std::vector<Metric> metrics;
  Comparison all;
  for (const MethodName& m : kMethods) {
    all.push_back(searches(m.method, size, run.seed, each_done));
    add_method(metrics, std::string(m.name), all.back());
  }
  trace_progress(run, all, size.budget);

  // As in the paper: the best of the genetic designs after refinement by SQP.
  const SearchLog& a =
      *std::max_element(all.back().begin(), all.back().end(),
                        [](const SearchLog& l, const SearchLog& r) { return l.value() < r.value(); });
  const Interchange chain = interchange(a, size.budget);
  add_design(metrics, "a", chain.a);
  add_design(metrics, "b", chain.b);
  add_design(metrics, "a_again", chain.a_again);
  const DeltaGeometry catalog = reconstructed_delta().geometry;
  const CatalogFit fit = best_depth(catalog, synthesis_demand(), kSynthesisSide_m);
  metrics.push_back({"catalog_conditioning", fit.conditioning, ""});
  metrics.push_back({"catalog_depth_m", fit.depth_m, "m"});
  if (a.feasible()) {
    trace_front(run, a, catalog, size.budget / 5);
    trace_slice(run, a.problem().dimensions(a.best()), catalog, fit.depth_m);
  }
  if (run.progress) run.progress(1.0);
  return metrics;
}

std::vector<Metric> run_synthesis(const ExperimentRun& run) { return synthesise(run, {}); }

}  // namespace longreach
