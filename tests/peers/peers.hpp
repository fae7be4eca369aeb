#pragma once
// Other people's libraries in the same run: their time over ours, for the same question.

#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// KDL's inverse (LMA) and Ceres Solver's fit against ours on the data of the stages `arm_inverse` and `estimator` of
/// the experiment `trade`; Simbody's Hunt-Crossley force and MuJoCo's step.
std::vector<Metric> run_peers(const ExperimentRun& run);

}  // namespace longreach
