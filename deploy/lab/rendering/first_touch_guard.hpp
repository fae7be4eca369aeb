#pragma once
// Study of the first touch at the slave. Measures the peak force at 50 mm/s on a wall of 5 N/mm, with and
// without the force guard, for the range of robots that the force guard must support.

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/plot.hpp"

namespace longreach {

/// Runs the study and writes the trace `first-touch-guard` to `out`.
std::vector<Metric> run_first_touch_guard(const std::filesystem::path& out);
Plot first_touch_guard_plot();

}  // namespace longreach
