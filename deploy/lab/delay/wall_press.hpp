#pragma once
// What the hand finds in the wall by a comparison law: it backs off, comes in, presses, presses twice as
// much, and lets go; each for as long as the link needs to settle. No probing: the kindest way to ask a
// delayed law.

#include <functional>

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

struct Pressed {
  double displayed_n_per_m = 0.0;  // change of force over change of depth between the two presses, at rest
  bool limit_cycle = false;        // moves by more than 0.1 mm, and bounces or does not die away
  double motion_m = 0.0;           // from peak to peak in the last quarter of the second press
  double port_energy_min_j = 0.0;  // what the hand has been given, at most
  double drawdown_j = 0.0;         // largest fall of E_port - E_wall (what the line stores counts)
  double force_peak_n = 0.0;
};

/// `watch`, where there is one, sees the bench after each sample.
Pressed press_wall(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch = {});

}  // namespace longreach
