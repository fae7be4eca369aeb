#pragma once
// Test of a comparison law at a wall: the hand retreats, approaches, presses, presses twice as much, and
// releases, each for as long as the link needs to settle. Without probing, the most favourable test of a law
// with delay.

#include <functional>

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

struct Pressed {
  double displayed_n_per_m = 0.0;  // change of force over change of depth between the two presses, at rest
  bool limit_cycle = false;        // moves by more than 0.1 mm, and bounces or does not decay
  double motion_m = 0.0;           // peak to peak in the last quarter of the second press
  double port_energy_min_j = 0.0;  // maximum energy returned to the operator, negative
  double drawdown_j = 0.0;         // maximum decrease of E_port - E_wall (energy stored in the line counts)
  double force_peak_n = 0.0;
};

/// `watch`, if given, is called after each sample.
Pressed press_wall(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch = {});

}  // namespace longreach
