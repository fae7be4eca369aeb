#pragma once
// The main experiment with a recording of both sides, OUT/touch.mcap. The run is identical.

#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Throws RecordingError.
std::vector<Metric> run_touch_recorded(const ExperimentRun& run);

}  // namespace longreach
