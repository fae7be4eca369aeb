#pragma once
// Compares other libraries with longreach in the same run: ratio of their time to ours for the same problem.

#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// KDL's inverse (LMA) and Ceres Solver's fit against ours on the data of the stages `arm_inverse` and `estimator` of
/// the experiment `trade`; Simbody's Hunt-Crossley force and MuJoCo's step.
std::vector<Metric> run_peers(const ExperimentRun& run);

}  // namespace longreach
