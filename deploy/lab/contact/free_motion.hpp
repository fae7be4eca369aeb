#pragma once
// Tests a force sensor with noise, drift, offset and tool mass that differ from the configured values, so
// that the slave must derive the touch threshold and the zero offset from the data. The tool moves freely at
// up to 0.25 m/s and then touches a wall, at a normal speed or at 0.1 mm/s.

#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach {

struct FreeMotionCell {
  double noise_n = 0.05;  // standard deviation of a sample, per axis
  double drift_n = 0.05;  // standard deviation of the drift after one second
  double bias_n = 0.0;
  double mass_kg = 1.0;     // mass of the tool
  double mass_error = 0.0;  // relative error of the configured mass
  bool gravity = false;
  double touch_n = 0.0;  // configured touch threshold; 0: derived
  double moving_s = 60.0;
  double speed_m_per_s = 0.02;  // approach speed at the wall; 1e-4 in the slow case
  double stiffness_n_per_m = 1000.0;
};

struct FreeMotionResult {
  double moved_s = 0.0;    // time of motion faster than 5 mm/s without contact
  int false_contacts = 0;  // contacts that were reported before the wall was reached
  double false_s = 0.0;    // time of the first false contact
  double touch_n = 0.0;    // touch threshold when the wall is touched
  /// Time from the instant when the force reaches twice the threshold until the contact is reported; 0 if it
  /// is reported earlier.
  double found_s = 0.0;
  double found_n = 0.0;  // force at the time when the contact was reported
  bool found = false;
};

FreeMotionCell draw_free_motion(Random& random, bool slow);
FreeMotionResult run_free_motion(const ExperimentRun& run, const FreeMotionCell& cell);

}  // namespace longreach
