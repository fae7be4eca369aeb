#pragma once
// `longreach-lab run NAME --seeds A:B` runs an experiment once with each seed of a range.

#include <cstdint>
#include <string>

#include "deploy/lab/experiment.hpp"

namespace longreach {

struct SeedRange {
  std::uint64_t first = 1, last = 1;
};

/// Reads "A:B" with A <= B, or "A". Throws ConfigError if the text is not a range or has more than 100,000 seeds.
SeedRange seed_range(const std::string& text);

/// Runs the experiment with each seed on all cores. Prints for each seed, in order, whether all checks of its trials hold,
/// then the worst check and the range of each metric that varies. The worst check exceeds its bound by the largest share of the
/// bound, or by the largest value if the bound is zero. Returns 0, 1 if a seed failed, or 3 if none failed but some had
/// no contact. A seed fails if a check fails or the experiment throws std::exception.
int run_seeds(const Experiment& experiment, const ExperimentRun& run, SeedRange seeds, bool quiet);

}  // namespace longreach
