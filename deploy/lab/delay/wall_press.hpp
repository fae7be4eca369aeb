#pragma once
// Tests a comparison law at a wall. The hand retreats, approaches, presses, presses with twice the force, and
// releases the handle; each step lasts long enough for the link to settle. There is no probing, which makes
// this the most favourable test for a law under delay.

#include <functional>

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

struct Pressed {
  /// Change of force / change of depth from the first to the second press, both at rest.
  double displayed_n_per_m = 0.0;
  /// True if the handle moves by more than 0.1 mm, and bounces or oscillates without decaying.
  bool limit_cycle = false;
  double motion_m = 0.0;  // peak-to-peak motion in the last quarter of the second press
  /// Minimum of the port energy; negative: energy was returned to the operator.
  double port_energy_min_j = 0.0;
  /// Maximum decrease of E_port - E_wall, which includes the energy stored in the link.
  double drawdown_j = 0.0;
  double force_peak_n = 0.0;
};

/// Runs the test. `watch`, if given, is called after each sample.
Pressed press_wall(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch = {});

}  // namespace longreach
