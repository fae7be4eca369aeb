// The trade-off of the operator between time and error in the path task. Sweeps the speed of rate mode, the
// scale of position mode, the dead zone, and the point at which hybrid mode switches from rate to position,
// with the same simulated operators and paths as in path-task. Beyond these ranges, at k_v = 8/s or a dead
// zone of 20 mm, the smallest motion of rate mode exceeds the size of a target, and most operators never
// finish.

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mapping/path_results.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kRtt_s = 0.225;

struct Sweep {
  std::string_view name;   // name in metrics and traces
  std::string_view title;  // title in the plots
  PathStrategy strategy;   // strategies that depend on it
  void (*set)(proto::Mapping& mapping, PathCase& c, double value);
  double (*present)(const proto::Mapping& mapping);
  std::array<double, 5> values;
};

const std::array<Sweep, 4> kSweeps = {
    {{"kv_per_s",
      "k_v = 0.5, 1, 2, 3, 4 1/s",
      PathStrategy::kRate,
      [](proto::Mapping& m, PathCase&, double v) { m.set_kv_per_s(v); },
      [](const proto::Mapping& m) { return m.kv_per_s(); },
      {0.5, 1.0, 2.0, 3.0, 4.0}},
     {"k_scale",
      "k_{scale} = 0.2, 0.4, 0.6, 0.8, 1",
      PathStrategy::kPosition,
      [](proto::Mapping& m, PathCase&, double v) { m.set_scale(v); },
      [](const proto::Mapping& m) { return m.scale(); },
      {0.2, 0.4, 0.6, 0.8, 1.0}},
     {"r_dz_mm",
      "r_{dz} = 1, 2.5, 5, 7.5, 10 mm",
      PathStrategy::kRate,
      [](proto::Mapping& m, PathCase&, double v) { m.set_dead_zone_m(1e-3 * v); },
      [](const proto::Mapping& m) { return 1e3 * m.dead_zone_m(); },
      {1.0, 2.5, 5.0, 7.5, 10.0}},
     {"near_sd",
      "near = 0, 1, 2.1, 3, 4 sd",
      PathStrategy::kHybrid,
      [](proto::Mapping&, PathCase& c, double v) { c.near_sd = v; },
      [](const proto::Mapping&) { return PathCase{}.near_sd; },
      {0.0, 1.0, kNearSd, 3.0, 4.0}}}};

std::string name_of(const Sweep& sweep) {
  return std::string(to_string(sweep.strategy)) + "_" + std::string(sweep.name);
}

Panel panel_of(const Sweep& sweep) {
  const std::string csv = name_of(sweep), mode(to_string(sweep.strategy));
  const auto point = [&](const char* column, const char* title, int mark, int colour) {
    return Curve{.column = column,
                 .title = title,
                 .factor = 1e3,
                 .points = true,
                 .mark = mark,
                 .colour = colour,
                 .csv = csv};
  };
  Panel panel{.y_label = "distance from the path (mm)", .curves = {}, .extra = "set yrange [0:*]"};
  panel.curves.push_back({.column = "error_m",
                          .title = mode + ", sd",
                          .factor = 1e3,
                          .csv = csv,
                          .low = "error_low_m",
                          .high = "error_high_m"});
  panel.curves.push_back(point("first_m", "first value", 5, 2));
  panel.curves.push_back(point("default_m", "default", 7, 1));
  return panel;
}

void write(Trace& trace, const PathSample& s, double value, bool first, bool present) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Spread time = spread_of(s.time_s), error = spread_of(s.error_m);
  trace.row({value, time.mean, time.sd, error.mean, error.mean - error.sd, error.mean + error.sd,
             first ? error.mean : kNone, present ? error.mean : kNone});
}

}  // namespace

std::vector<Plot> mapping_trade_plots() {
  std::vector<Plot> plots;
  for (const Sweep& sweep : kSweeps)
    plots.push_back({.name = "mapping-trade-" + std::string(sweep.name),
                     .csv = name_of(sweep),
                     .title = "Error against time, " + std::string(to_string(sweep.strategy)) +
                              " mode, round trip 0.225 s: " + std::string(sweep.title),
                     .x_column = "time_s",
                     .x_label = "time (s)",
                     .panels = {panel_of(sweep)},
                     .panel_px = 260.0});
  return plots;
}

std::vector<Metric> run_mapping_trade(const ExperimentRun& run) {
  const proto::LabConfig task = path_task_config(run.config);
  const PathSize size = PathSize::chosen(6);
  const double all = 5.0 * static_cast<double>(kSweeps.size());
  int done = 0, unfinished = 0;
  std::vector<Metric> metrics = {{"operators", static_cast<double>(size.persons), "simulated"},
                                 {"rtt_s", kRtt_s, "s"}};
  for (const Sweep& sweep : kSweeps) {
    const std::string name = name_of(sweep);
    Trace trace(
        run.out, name,
        {"value", "time_s", "time_sd_s", "error_m", "error_low_m", "error_high_m", "first_m", "default_m"});
    for (const double value : sweep.values) {
      proto::LabConfig config = task;
      PathCase c{.strategy = sweep.strategy, .rtt_s = kRtt_s, .seed = run.seed};
      sweep.set(*config.mutable_master()->mutable_mapping(), c, value);
      const PathSample s = sample_paths(config, c, size, [&](double share) {
        if (run.progress) run.progress((done + share) / all);
      });
      ++done;
      unfinished += s.unfinished;
      const std::string suffix = "at_" + short_number(value);
      add_spread(metrics, name + "_time_s", suffix, s.time_s, "s");
      add_spread(metrics, name + "_error_m", suffix, s.error_m, "m");
      const double present = sweep.present(task.master().mapping());
      write(trace, s, value, value == sweep.values.front(), std::abs(value - present) < 1e-9);
    }
    trace.close();
  }
  metrics.push_back({"unfinished", static_cast<double>(unfinished), ""});
  return metrics;
}

}  // namespace longreach
