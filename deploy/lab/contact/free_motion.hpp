#pragma once
// A force sensor of which nothing true is configured: the tool moves freely at up to 0.25 m/s, and then meets
// a wall, as usual or at 0.1 mm/s. Its thresholds and zero are derived.

#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach {

struct FreeMotionCell {
  double noise_n = 0.05;  // of a sample, along each axis
  double drift_n = 0.05;  // standard deviation after a second
  double bias_n = 0.0;
  double mass_kg = 1.0;     // of the tool
  double mass_error = 0.0;  // share, by which the configured mass is off
  bool gravity = false;
  double touch_n = 0.0;  // as configured; 0: derived
  double moving_s = 60.0;
  double speed_m_per_s = 0.02;  // at the wall; 1e-4: slow
  double stiffness_n_per_m = 1000.0;
};

struct FreeMotionResult {
  double moved_s = 0.0;    // faster than 5 mm/s, without contact
  int false_contacts = 0;  // begun while nothing was touched
  double false_s = 0.0;    // when the first of them began
  double touch_n = 0.0;    // threshold at the wall
  double found_s = 0.0;    // from a force of twice the threshold until the contact is found; 0: before that
  double found_n = 0.0;    // force when it was found
  bool found = false;
};

FreeMotionCell draw_free_motion(Random& random, bool slow);
FreeMotionResult run_free_motion(const ExperimentRun& run, const FreeMotionCell& cell);

}  // namespace longreach
