#pragma once
// Other people's libraries in the same run: their time over ours, for the same question.

#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// KDL's inverse (LMA) and Ceres Solver's fit from the points of those stages; Simbody's Hunt-Crossley force
/// and MuJoCo's step measured here.
std::vector<Metric> peer_ratios(const std::vector<TradePoint>& arm, const std::vector<TradePoint>& estimator);

}  // namespace longreach
