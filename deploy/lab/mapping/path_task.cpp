// The path-and-target task of the source paper (Fig. 19, Table 2): simulated operators in three modes, over
// four round trips, with and without the ghost. Both nodes run in each trial. The comparison is paired: every
// operator does every case on the same paths. The operators are a model that is not validated with people.

#include <array>
#include <string>

#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mapping/path_results.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

struct Delay {
  double rtt_s;
  double slow_down_least, slow_down_most;  // predicted by the model: time relative to that without delay
};
constexpr std::array<Delay, 4> kDelays = {
    {{0.0, 1.0, 1.0}, {0.225, 1.3, 1.8}, {1.5, 2.0, 3.0}, {2.6, 2.3, 4.5}}};
constexpr std::array kStrategies = {PathStrategy::kRate, PathStrategy::kPosition, PathStrategy::kHybrid};
constexpr double kTraceRtt_s = 2.6;  // round trip of the traces

/// Results of one display: [strategy][delay].
using Samples = std::array<std::array<PathSample, kDelays.size()>, kPathStrategies>;

const PathSample& at(const Samples& s, PathStrategy strategy, std::size_t delay) {
  return s[static_cast<std::size_t>(strategy)][delay];
}

std::string at_delay(std::size_t delay) { return "at_" + short_number(kDelays[delay].rtt_s); }

std::string picture_of(bool ghost) { return ghost ? "ghost_" : ""; }

std::vector<double> slow_down(const Samples& s, PathStrategy strategy, std::size_t delay) {
  std::vector<double> ratio = at(s, strategy, delay).time_s;
  for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] /= at(s, strategy, 0).time_s[i];
  return ratio;
}

void add_samples(std::vector<Metric>& metrics, const Samples& s, bool ghost) {
  for (const PathStrategy strategy : kStrategies) {
    const std::string name = picture_of(ghost) + std::string(to_string(strategy));
    for (std::size_t d = 0; d < kDelays.size(); ++d) {
      const PathSample& sample = at(s, strategy, d);
      add_spread(metrics, name + "_time_s", at_delay(d), sample.time_s, "s");
      add_spread(metrics, name + "_error_m", at_delay(d), sample.error_m, "m");
      add_spread(metrics, name + "_target_error_m", at_delay(d), sample.target_error_m, "m");
      metrics.push_back({name + "_moves_" + at_delay(d), sample.moves, "per trial"});
      metrics.push_back({name + "_relocations_" + at_delay(d), sample.relocations, "per trial"});
      if (d > 0) add_spread(metrics, name + "_slow_down", at_delay(d), slow_down(s, strategy, d), "");
    }
  }
}

/// Tests, with paired samples, whether hybrid mode is better than the other mode. Adds the difference, its
/// significance, and the number of delays at which it is significant.
void compare(std::vector<Metric>& metrics, const Samples& s, const std::string& name, PathStrategy other,
             std::vector<double> PathSample::*figure, const char* unit) {
  int better = 0, surely = 0;
  for (std::size_t d = 0; d < kDelays.size(); ++d) {
    const std::vector<double> gain = paired(at(s, other, d).*figure, at(s, PathStrategy::kHybrid, d).*figure);
    const double mean = spread_of(gain).mean, p = signed_rank_p(gain);
    add_spread(metrics, name, at_delay(d), gain, unit);
    metrics.push_back({name + "_p_" + at_delay(d), p, "two-sided signed-rank test"});
    better += mean > 0.0;
    surely += mean > 0.0 && p < 0.05;
  }
  metrics.push_back({name + "_delays", static_cast<double>(better), ""});
  metrics.push_back({name + "_delays_surely", static_cast<double>(surely), "p < 0.05"});
}

void add_bands(std::vector<Metric>& metrics, const Samples& s) {
  for (std::size_t d = 1; d < kDelays.size(); ++d) {
    int in_band = 0;
    for (const PathStrategy strategy : kStrategies) {
      const double mean = spread_of(slow_down(s, strategy, d)).mean;
      in_band += mean >= kDelays[d].slow_down_least && mean <= kDelays[d].slow_down_most;
    }
    metrics.push_back({"slow_downs_in_band_" + at_delay(d), static_cast<double>(in_band), "of 3"});
  }
}

/// Writes STRATEGY.csv and ghost_STRATEGY.csv over the delay, with small offsets so that error bars do not
/// overlap.
void write_samples(const ExperimentRun& run, const Samples& s, bool ghost) {
  for (const PathStrategy strategy : kStrategies) {
    Trace trace(run.out, picture_of(ghost) + std::string(to_string(strategy)),
                {"rtt_s", "time_s", "time_low_s", "time_high_s", "error_m", "error_low_m", "error_high_m"});
    for (std::size_t d = 0; d < kDelays.size(); ++d) {
      const Spread time = spread_of(at(s, strategy, d).time_s), error = spread_of(at(s, strategy, d).error_m);
      trace.row({kDelays[d].rtt_s + 0.03 * (static_cast<int>(strategy) - 1), time.median, time.low, time.high,
                 error.median, error.low, error.high});
    }
    trace.close();
  }
}

/// Traces one trial in each mode, and its path.
void write_traces(const ExperimentRun& run, const proto::LabConfig& config) {
  PathCase c{.rtt_s = kTraceRtt_s, .seed = run.seed};
  for (const PathStrategy strategy : kStrategies) {
    c.strategy = strategy;
    Trace trace = path_trace(run.out, "trace_" + std::string(to_string(strategy)));
    run_path_trial(config, c, &trace);
    trace.close();
  }
  Trace way(run.out, "way", {"right_m", "up_m"});
  for (const Vector3& p : course_of(config, c).drawn_m) way.row({drawn(p).x(), drawn(p).y()});
  way.close();
}

Panel over_delay(const std::string& label, const std::string& column, double factor, bool ghost) {
  Panel panel{.y_label = label, .curves = {}, .extra = "set yrange [0:*]\nset xrange [-0.15:2.75]"};
  for (const PathStrategy strategy : kStrategies) {
    const std::string name(to_string(strategy)), unit = column == "time" ? "_s" : "_m";
    panel.curves.push_back({.column = column + unit,
                            .title = name,
                            .factor = factor,
                            .csv = picture_of(ghost) + name,
                            .low = column + "_low" + unit,
                            .high = column + "_high" + unit});
  }
  return panel;
}

Panel trace_panel(PathStrategy strategy) {
  const std::string name(to_string(strategy));
  return {.y_label = name + " (mm)",
          .curves = {{.column = "up_m", .title = "path", .factor = 1e3, .colour = 4, .csv = "way"},
                     {.column = "up_m", .title = "tool", .factor = 1e3, .colour = 0, .csv = "trace_" + name}},
          .extra = "set xrange [-10:290]"};
}

}  // namespace

std::vector<Plot> path_task_plots() {
  return {{.name = "path-task",
           .csv = "rate",
           .title = "Path-and-target task: median and quartiles over the simulated operators",
           .x_column = "rtt_s",
           .x_label = "round trip (s)",
           .panels = {over_delay("time (s)", "time", 1.0, false),
                      over_delay("time with ghost (s)", "time", 1.0, true),
                      over_delay("path error (mm)", "error", 1e3, false),
                      over_delay("path error with ghost (mm)", "error", 1e3, true)}},
          {.name = "path-task-traces",
           .csv = "way",
           .title = "One simulated operator at a round trip of 2.6 s, seen perpendicular to the diagonal "
                    "(vertical axis stretched)",
           .x_column = "right_m",
           .x_label = "along x + y + z (mm)",
           .x_factor = 1e3,
           .panels = {trace_panel(PathStrategy::kRate), trace_panel(PathStrategy::kPosition),
                      trace_panel(PathStrategy::kHybrid)},
           .panel_px = 190.0}};
}

std::vector<Metric> run_path_task(const ExperimentRun& run) {
  const proto::LabConfig config = path_task_config(run.config);
  const PathSize size = PathSize::chosen();
  const int all = 2 * kPathStrategies * static_cast<int>(kDelays.size());
  int done = 0, unfinished = 0;
  const auto progress = [&](double share) {
    if (run.progress) run.progress((done + share) / all);
  };
  std::array<Samples, 2> samples;
  std::vector<Metric> metrics = {{"operators", static_cast<double>(size.persons), "simulated"},
                                 {"trials", static_cast<double>(all * size.persons * size.trials), ""}};
  for (const bool ghost : {false, true}) {
    Samples& s = samples[ghost ? 1 : 0];
    for (const PathStrategy strategy : kStrategies) {
      for (std::size_t d = 0; d < kDelays.size(); ++d) {
        PathSample& sample = s[static_cast<std::size_t>(strategy)][d];
        sample = sample_paths(
            config, {.strategy = strategy, .rtt_s = kDelays[d].rtt_s, .ghost = ghost, .seed = run.seed}, size,
            progress);
        ++done;
        unfinished += sample.unfinished;
      }
    }
    add_samples(metrics, s, ghost);
    write_samples(run, s, ghost);
  }
  metrics.push_back({"unfinished", static_cast<double>(unfinished), ""});
  compare(metrics, samples[0], "hybrid_gains_on_position", PathStrategy::kPosition, &PathSample::time_s, "s");
  compare(metrics, samples[0], "hybrid_gains_on_rate", PathStrategy::kRate, &PathSample::error_m, "m");
  add_bands(metrics, samples[0]);
  if (!run.out.empty()) write_traces(run, config);
  return metrics;
}

}  // namespace longreach
