#pragma once
// The first touch at the slave: the effect of the force guard at 50 mm/s on 5 N/mm, over the robots that it
// must support, and the same touches without it.

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/plot.hpp"

namespace longreach {

/// Writes the trace `first-touch-guard` to `out`.
std::vector<Metric> run_first_touch_guard(const std::filesystem::path& out);
Plot first_touch_guard_plot();

}  // namespace longreach
