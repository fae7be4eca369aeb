#pragma once
// `longreach-lab run` runs one experiment and prints its metrics; `longreach-lab list` lists the experiments.

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

struct LabRunOptions {
  std::string name;
  std::uint64_t seed = 1;
  std::string seeds;  // "A:B": run once with each seed from A to B; empty: only `seed`
  std::string only;   // see ExperimentRun
  std::vector<std::string> settings;
  std::string out;
  bool record = false;
  bool quiet = false;
};

/// Returns the exit status: 0, 3 if there was no contact, or 1 if a run with one of several seeds failed. Throws ConfigError if the experiment or a
/// setting is unknown, or if the experiment does not use a setting.
int run(const LabRunOptions& options);

/// Runs the experiment with a progress line. Then, unless `quiet` is set, prints the outcome, the metrics,
/// the commit, the configuration hash and the seed.
std::vector<Metric> run_and_print(const Experiment& experiment, ExperimentRun run, bool quiet);

void list_experiments();

/// Returns a value of a metric with six significant digits.
std::string metric_text(double value);

}  // namespace longreach
