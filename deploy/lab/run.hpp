#pragma once
// `longreach-lab run` and `list`: runs one experiment and prints its metrics.

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

struct LabRunOptions {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> settings;
  std::string out;
  bool record = false;
  bool quiet = false;
};

/// Exit status: 0, or 3 if there was no contact. Throws ConfigError for an unknown experiment or setting, or
/// a setting that the experiment does not use.
int run(const LabRunOptions& options);

/// Runs it with a progress line; then prints, unless quiet, the outcome, the metrics and the identity of the
/// run.
std::vector<Metric> run_and_print(const Experiment& experiment, ExperimentRun run, bool quiet);

void list_experiments();

}  // namespace longreach
