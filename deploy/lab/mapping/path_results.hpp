#pragma once
// Results of simulated operators in one mode: a value for each operator, the mean of the trials.

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
  double moves = 0.0, relocations = 0.0;                // per trial, mean
  int unfinished = 0;                                   // trials
};

struct PathSize {
  int persons = 100, trials = 2;
  /// by LONGREACH_FULL; 20 persons are too few to distinguish the modes with certainty
  static PathSize chosen();
};

/// Runs `c` with each operator, on all cores; `progress`, if given, is called with the completed share.
PathSample sample_paths(const proto::LabConfig& config, const PathCase& c, PathSize size,
                        const std::function<void(double)>& progress = {});

/// a - b for each operator.
std::vector<double> paired(const std::vector<double>& a, const std::vector<double>& b);

/// Mean and standard deviation over the operators, as NAME_SUFFIX and NAME_sd_SUFFIX.
void add_spread(std::vector<Metric>& metrics, const std::string& name, const std::string& suffix,
                const std::vector<double>& sample, const std::string& unit);

}  // namespace longreach
