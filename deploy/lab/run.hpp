#pragma once
// `longreach-lab run` and `list`: one experiment, its metrics printed.

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

/// Exit status: 0, or 3 when there was no contact. Throws ConfigError for an experiment or a setting that is
/// none, or that the experiment does not use.
int run(const LabRunOptions& options);

/// Runs it with a line of progress; then prints, unless quiet, the outcome, the metrics and the run's name.
std::vector<Metric> run_and_print(const Experiment& experiment, ExperimentRun run, bool quiet);

void list_experiments();

}  // namespace longreach
