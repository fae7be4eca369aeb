#pragma once
// Compares the speed of other libraries with that of longreach, as the ratio of their time to ours for the
// same problem in the same run.

#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// Compares KDL's inverse kinematics (LMA) and a Ceres Solver fit with ours, on the data of the stages
/// `arm_inverse` and `estimator` of the experiment `trade`. Also compares Simbody's Hunt-Crossley force and
/// MuJoCo's step.
std::vector<Metric> run_peers(const ExperimentRun& run);

}  // namespace longreach
