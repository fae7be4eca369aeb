#pragma once
// Compares the speed of other libraries with that of longreach in the same run, as the ratio of their time to
// ours for the same problem.

#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// Compares KDL's inverse kinematics (LMA) and a fit with Ceres Solver with ours on the data of the stages
/// `arm_inverse` and `estimator` of the experiment `trade`; also compares Simbody's Hunt-Crossley force and
/// MuJoCo's step.
std::vector<Metric> run_peers(const ExperimentRun& run);

}  // namespace longreach
