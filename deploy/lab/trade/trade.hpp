#pragma once
// Cost against error of the methods of each stage. A point is on the front if no other point is both cheaper
// and more accurate.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// One method of a stage.
struct TradePoint {
  std::string series;   // one of the stage's
  std::string setting;  // within the series; empty: there is only one
  double cost = 0.0;    // > 0
  double error = 0.0;   // >= 0
  double instructions = std::numeric_limits<double>::quiet_NaN();  // per call; NaN: not counted
  bool standard = false;                                           // used by the defaults
};

struct TradeStage {
  std::string_view name;  // of its metrics and its trace
  std::string_view title;
  std::string_view cost, cost_unit;    // "time of a call", "ns"
  std::string_view error, error_unit;  // "largest error", "rad"
  bool of_machine = true;              // the cost is a time of this machine
  std::vector<std::string_view> series;
  std::vector<TradePoint> (*measure)(const ExperimentRun& run);
};

/// Whether no other point is cheaper and at least as accurate, or more accurate and at most as expensive.
bool on_front(const std::vector<TradePoint>& points, std::size_t which);

// The stages, one file each.
TradeStage trade_spherical_forward();
TradeStage trade_delta_forward();
TradeStage trade_arm_inverse();
TradeStage trade_contact();
TradeStage trade_estimator();
TradeStage trade_sample_rate();
TradeStage trade_send_rate();
TradeStage trade_playout();
TradeStage trade_deadband();
TradeStage trade_precision();
TradeStage trade_accuracy_tracking();
TradeStage trade_accuracy_stiffness();

}  // namespace longreach
