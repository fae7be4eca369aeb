#pragma once
// Complete laboratory runs for the experiment `trade`: the tracking error of the tool, and the error of the
// displayed stiffness.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Results of a run in which the hand moves back and forth in three dimensions in free space for one minute,
/// at up to 20 mm/s. The tool position is compared with the command that was sent one link delay earlier.
struct Tracking {
  double error_rms_m = 0.0;
  double late_s = 0.0;              // additional delay (beyond that of the link) that fits best
  double bent_rms_m = 0.0;          // remaining error with this delay
  double roughness_m_per_s2 = 0.0;  // rms acceleration of the tool; 0.02 for the hand
  double kbit_per_s = 0.0;          // data rate of the commands, including headers
  /// Run time of both sides and the simulation, per millisecond of virtual time.
  double cost_us = 0.0;
};
/// Runs this motion. `settings` (PATH=VALUE) are applied in addition to those of the run. The link is
/// `analog` unless the settings name a profile.
Tracking track(const ExperimentRun& run, std::vector<std::string> settings);

/// Results of the experiment `touch` over the same link with several seeds.
struct Touched {
  double stiffness_error = 0.0;   // maximum over the seeds
  double return_bit_per_s = 0.0;  // mean over the seeds
};
Touched touched(const ExperimentRun& run, std::vector<std::string> settings);

}  // namespace longreach
