#include "deploy/lab/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "common/config/config.hpp"
#include "deploy/lab/progress_line.hpp"
#include "deploy/lab/seeds.hpp"
#include "deploy/lab/settings_used.hpp"
#include "deploy/lab/touch.hpp"

namespace longreach {
namespace {

constexpr int kDone = 0, kNoContact = 3;

// Verification of the project itself is not an experiment but a program under tests/.
constexpr std::string_view kPrograms[] = {"extremes", "faults"};

}  // namespace

std::string metric_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void list_experiments() {
  for (const Experiment& e : experiments()) {
    const std::string figure = e.figure.empty() ? "" : " (" + std::string(e.figure) + ")";
    std::printf("%-16s %s%s\n", std::string(e.name).c_str(), std::string(e.summary).c_str(), figure.c_str());
  }
}

std::vector<Metric> run_and_print(const Experiment& experiment, ExperimentRun run, bool quiet) {
  const std::string name(experiment.name);
  ProgressLine line(quiet);
  run.progress = [&](double done) {
    line.show(name + ": " + std::to_string(std::lround(100.0 * done)) + " %", done);
  };
  const auto began = std::chrono::steady_clock::now();
  const auto complain = [](const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); };
  std::vector<Metric> metrics = run_experiment(experiment, run, complain);
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  line.clear();
  if (quiet) return metrics;
  const std::string_view outcome = outcome_of(metrics);
  if (!outcome.empty()) std::printf("outcome: %s\n", std::string(outcome).c_str());
  for (const Metric& m : metrics) {
    std::printf("%-32s %14s %s\n", m.name.c_str(), metric_text(m.value).c_str(), m.unit.c_str());
    if (m.name == "duration_s")
      std::printf("%-32s %14s\n", "times_faster_than_real_time", metric_text(m.value / spent).c_str());
  }
  std::printf("commit %s, config %s, seed %llu%s%s\n", std::string(commit()).c_str(),
              config_hash(run.config).c_str(), static_cast<unsigned long long>(run.seed),
              run.out.empty() ? "" : "; written to ", run.out.c_str());
  return metrics;
}

int run(const LabRunOptions& o) {
  if (std::ranges::find(kPrograms, o.name) != std::end(kPrograms))
    throw ConfigError(o.name +
                      " is not an experiment but a separate program that verifies longreach. Build it "
                      "with `cmake --build --preset release --target " +
                      o.name + "` and run `build/release/bin/" + o.name + "`");
  const Experiment* experiment = find_experiment(o.name);
  if (!experiment)
    throw ConfigError("unknown experiment '" + o.name + "'; `longreach-lab list` prints the names");
  ExperimentRun r;
  r.config = configure(o.settings, find_deploy_folder());
  r.seed = o.seed;
  r.out = o.out;
  r.only = o.only;
  if (!o.only.empty() && !experiment->trials)
    throw ConfigError("--only requires an experiment with named trials: person");
  refuse_unused(*experiment, o.settings);
  Experiment chosen = *experiment;
  if (o.record) {
    if (o.name != "touch" || o.out.empty())
      throw ConfigError(
          "--record requires --out DIR and the experiment touch; the other experiments consist of "
          "several runs");
    if (!o.seeds.empty()) throw ConfigError("--record requires a single seed; use --seed instead of --seeds");
    chosen.run = run_touch_recorded;
  }
  if (!o.seeds.empty()) return run_seeds(chosen, r, seed_range(o.seeds), o.quiet);
  return outcome_of(run_and_print(chosen, r, o.quiet)).empty() ? kDone : kNoContact;
}

}  // namespace longreach
