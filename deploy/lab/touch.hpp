#pragma once
// The experiment `touch` with a recording of both sides in OUT/touch.mcap. The recording does not affect the
// run.

#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Runs the experiment. Throws RecordingError if the recording cannot be written.
std::vector<Metric> run_touch_recorded(const ExperimentRun& run);

}  // namespace longreach
