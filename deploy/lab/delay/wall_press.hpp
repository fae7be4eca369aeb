#pragma once
// Test of a comparison law at a wall. The hand retreats, approaches, presses, presses with twice the force,
// and releases; each step lasts long enough for the link to settle. There is no probing, which makes this the
// most favourable test of a law with delay.

#include <functional>

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

struct Pressed {
  double displayed_n_per_m = 0.0;  // change of force / change of depth between the two presses at rest
  /// True if the handle moves by more than 0.1 mm and this motion bounces or does not decay.
  bool limit_cycle = false;
  double motion_m = 0.0;           // peak-to-peak motion in the last quarter of the second press
  double port_energy_min_j = 0.0;  // minimum of the port energy; negative: returned to the operator
  /// Maximum decrease of E_port - E_wall; energy stored in the line is included.
  double drawdown_j = 0.0;
  double force_peak_n = 0.0;
};

/// Runs the test. `watch`, if given, is called after each sample.
Pressed press_wall(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch = {});

}  // namespace longreach
