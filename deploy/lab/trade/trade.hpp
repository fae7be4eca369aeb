#pragma once
// Cost versus error of the methods of each stage. A point is on the Pareto front if no other point dominates
// it.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// One method of a stage, with one setting.
struct TradePoint {
  std::string series;   // name of its series, one of TradeStage::series
  std::string setting;  // setting within the series; empty if there is only one
  double cost = 0.0;    // > 0
  double error = 0.0;   // >= 0
  double instructions = std::numeric_limits<double>::quiet_NaN();  // per call; NaN: not counted
  bool standard = false;                                           // used by the defaults
};

struct TradeStage {
  std::string_view name;  // used in the names of the stage's metrics and trace
  std::string_view title;
  std::string_view cost, cost_unit;    // e.g. "time per call", "ns"
  std::string_view error, error_unit;  // e.g. "maximum error", "rad"
  bool of_machine = true;              // the cost is a time measured on this machine
  std::vector<std::string_view> series;
  std::vector<TradePoint> (*measure)(const ExperimentRun& run);
};

/// Returns true if no other point is cheaper and at least as accurate, or more accurate and at most as
/// expensive.
bool on_front(const std::vector<TradePoint>& points, std::size_t which);

// The stages. Each stage has its own source file.
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
