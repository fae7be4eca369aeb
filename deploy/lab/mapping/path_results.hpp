#pragma once
// What simulated operators did in one way of working: a figure for each, the mean of his trials.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mapping/path_trial.hpp"
#include "deploy/lab/mapping/sample.hpp"

namespace longreach {

struct PathSample {
  std::vector<double> time_s, error_m, target_error_m;  // of each operator
  double moves = 0.0, relocations = 0.0;                // a trial, mean
  int unfinished = 0;                                   // trials
};

struct PathSize {
  int persons = 100, trials = 2;
  static PathSize chosen();  // by LONGREACH_FULL; 20 persons differ too much to tell modes apart surely
};

/// Runs `c` with each operator, on all cores; `progress`, if any, is told the share done.
PathSample sample_paths(const proto::LabConfig& config, const PathCase& c, PathSize size,
                        const std::function<void(double)>& progress = {});

/// a - b of each.
std::vector<double> paired(const std::vector<double>& a, const std::vector<double>& b);

/// Mean and standard deviation over the operators, as NAME_SUFFIX and NAME_sd_SUFFIX.
void add_spread(std::vector<Metric>& metrics, const std::string& name, const std::string& suffix,
                const std::vector<double>& sample, const std::string& unit);

}  // namespace longreach
