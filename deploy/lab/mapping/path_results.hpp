#pragma once
// Results of the simulated operators in one mode. The value for an operator is the mean over the trials.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mapping/path_trial.hpp"
#include "deploy/lab/mapping/sample.hpp"

namespace longreach {

struct PathSample {
  std::vector<double> time_s, error_m, target_error_m, turned_rad;  // one value per operator
  double moves = 0.0, relocations = 0.0;                            // mean number per trial
  int unfinished = 0;                                               // number of unfinished trials
};

struct PathSize {
  int persons = 100, trials = 2;
  /// Returns the full size if LONGREACH_FULL is set, otherwise a small size with this number of operators.
  static PathSize chosen(int persons);
};

/// Runs case `c` with each operator, on all cores. `progress`, if given, is called with the completed
/// fraction.
PathSample sample_paths(const proto::LabConfig& config, const PathCase& c, PathSize size,
                        const std::function<void(double)>& progress = {});

/// Returns the difference a - b for each operator.
std::vector<double> paired(const std::vector<double>& a, const std::vector<double>& b);

/// Adds the mean and standard deviation over the operators as the metrics NAME_SUFFIX and NAME_sd_SUFFIX.
void add_spread(std::vector<Metric>& metrics, const std::string& name, const std::string& suffix,
                const std::vector<double>& sample, const std::string& unit);

}  // namespace longreach
