// The path-and-target task of the source paper (Fig. 19, Table 2): simulated operators in three modes, over
// four round trips, with and without the ghost, on the path of the scene and, over the shortest and the longest round trip,
// on one of twice the size. Both nodes run in each trial. The comparison is paired: every operator does every case on the
// same paths. Last, with a hand that turns the other handle: both motions, or only the translation is transferred. The
// operators are a model that is not validated with people.

#include <algorithm>
#include <array>
#include <span>
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
constexpr std::array<std::size_t, 4> kEachDelay = {0, 1, 2, 3};
constexpr std::array<std::size_t, 2> kEndDelays = {0, 3};
constexpr double kLarge = 2.0;       // size of the second path
constexpr double kTurns_rad = 0.05;  // of the other handle: more than its dead zone
constexpr std::size_t kTurnsDelay = 1;

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

void add_samples(std::vector<Metric>& metrics, const Samples& s, const std::string& prefix,
                 std::span<const std::size_t> delays) {
  for (const PathStrategy strategy : kStrategies) {
    const std::string name = prefix + std::string(to_string(strategy));
    for (const std::size_t d : delays) {
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
/// significance, the difference of the operator who gains least, and the number of delays at which it is significant.
void compare(std::vector<Metric>& metrics, const Samples& s, const std::string& name, PathStrategy other,
             std::vector<double> PathSample::*figure, const char* unit, std::span<const std::size_t> delays) {
  int better = 0, surely = 0;
  for (const std::size_t d : delays) {
    const std::vector<double> gain = paired(at(s, other, d).*figure, at(s, PathStrategy::kHybrid, d).*figure);
    const double mean = spread_of(gain).mean, p = signed_rank_p(gain);
    add_spread(metrics, name, at_delay(d), gain, unit);
    metrics.push_back({name + "_least_" + at_delay(d), *std::ranges::min_element(gain), unit});
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

/// Runs the cases one after the other, each with all operators.
class PathCases {
 public:
  PathCases(const ExperimentRun& run, const proto::LabConfig& config)
      : run_(run), config_(config), size_(PathSize::chosen(20)) {}

  PathSample sample(PathCase c) {
    c.seed = run_.seed;
    PathSample s = sample_paths(config_, c, size_, [&](double share) {
      if (run_.progress) run_.progress((done_ + share) / kAll);
    });
    ++done_;
    unfinished_ += s.unfinished;
    return s;
  }
  Samples samples(double size, bool ghost, std::span<const std::size_t> delays) {
    Samples s;
    for (const PathStrategy strategy : kStrategies)
      for (const std::size_t d : delays)
        s[static_cast<std::size_t>(strategy)][d] =
            sample({.strategy = strategy, .rtt_s = kDelays[d].rtt_s, .ghost = ghost, .size = size});
    return s;
  }
  [[nodiscard]] const PathSize& size() const { return size_; }
  [[nodiscard]] int done() const { return done_; }
  [[nodiscard]] int unfinished() const { return unfinished_; }

 private:
  static constexpr double kAll = kPathStrategies * (2.0 * kEachDelay.size() + kEndDelays.size() + 1.0) + 2.0;
  const ExperimentRun& run_;
  const proto::LabConfig& config_;
  PathSize size_;
  int done_ = 0, unfinished_ = 0;
};

/// The hand on the other handle turns while this one follows the path in hybrid mode: with and without the rule that only
/// the translation is transferred meanwhile.
void compare_simultaneous(std::vector<Metric>& metrics, PathCases& cases) {
  for (const SimultaneousMotion rule : {SimultaneousMotion::kBoth, SimultaneousMotion::kTranslation}) {
    const std::string name = rule == SimultaneousMotion::kBoth ? "both" : "translation";
    const PathSample s =
        cases.sample({.rtt_s = kDelays[kTurnsDelay].rtt_s, .turns_rad = kTurns_rad, .simultaneous = rule});
    metrics.push_back({name + "_time_s", spread_of(s.time_s).mean, "s"});
    metrics.push_back({name + "_error_m", spread_of(s.error_m).mean, "m"});
    metrics.push_back({name + "_turned_rad", spread_of(s.turned_rad).mean, "rad"});
    metrics.push_back({name + "_turned_most_rad", *std::ranges::max_element(s.turned_rad), "rad"});
  }
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
  PathCases cases(run, config);
  std::vector<Metric> metrics = {
      {"operators", static_cast<double>(cases.size().persons), "simulated"},
      {"reaches", reaches_of(config, {}), "length of the path over the reach of the handle"},
      {"large_reaches", reaches_of(config, {.size = kLarge}), ""}};
  const auto time = [&](const Samples& s, const std::string& prefix, std::span<const std::size_t> delays) {
    compare(metrics, s, prefix + "hybrid_gains_on_position", PathStrategy::kPosition, &PathSample::time_s,
            "s", delays);
  };
  const auto error = [&](const Samples& s, const std::string& prefix, std::span<const std::size_t> delays) {
    compare(metrics, s, prefix + "hybrid_gains_on_rate", PathStrategy::kRate, &PathSample::error_m, "m",
            delays);
  };
  for (const bool ghost : {false, true}) {
    const Samples s = cases.samples(1.0, ghost, kEachDelay);
    add_samples(metrics, s, picture_of(ghost), kEachDelay);
    write_samples(run, s, ghost);
    time(s, picture_of(ghost), kEachDelay);
    error(s, picture_of(ghost), kEachDelay);
    if (!ghost) add_bands(metrics, s);
  }
  const Samples large = cases.samples(kLarge, false, kEndDelays);
  Samples large_ghost;
  for (const PathStrategy strategy : kStrategies)
    large_ghost[static_cast<std::size_t>(strategy)][kEndDelays.back()] = cases.sample(
        {.strategy = strategy, .rtt_s = kDelays[kEndDelays.back()].rtt_s, .ghost = true, .size = kLarge});
  add_samples(metrics, large, "large_", kEndDelays);
  time(large, "large_", kEndDelays);
  error(large, "large_", kEndDelays);
  time(large_ghost, "large_ghost_", std::span(kEndDelays).last(1));
  compare_simultaneous(metrics, cases);
  metrics.push_back(
      {"trials", static_cast<double>(cases.done() * cases.size().persons * cases.size().trials), ""});
  metrics.push_back({"unfinished", static_cast<double>(cases.unfinished()), ""});
  if (!run.out.empty()) write_traces(run, config);
  return metrics;
}

}  // namespace longreach
