#pragma once
// Complete runs of the laboratory for `trade`: tracking error of the tool, and error of the displayed
// stiffness.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// The hand moves back and forth in three dimensions for a minute, at up to 20 mm/s, in free space; the tool
/// is compared with the command of one link delay before.
struct Tracking {
  double error_rms_m = 0.0;
  double late_s = 0.0;              // delay of the best fit, in addition to that of the link
  double bent_rms_m = 0.0;          // remaining error
  double roughness_m_per_s2 = 0.0;  // acceleration of the tool, rms; that of the hand is 0.02
  double kbit_per_s = 0.0;          // commands, including headers
  double cost_us = 0.0;             // of both sides and the simulation, per millisecond of virtual time
};
/// `settings`: PATH=VALUE, in addition to those of the run; over `analog` unless they name a profile.
Tracking track(const ExperimentRun& run, std::vector<std::string> settings);

/// The experiment `touch` over the same link, with some seeds.
struct Touched {
  double stiffness_error = 0.0;   // the worst of them
  double return_bit_per_s = 0.0;  // their mean
};
Touched touched(const ExperimentRun& run, std::vector<std::string> settings);

}  // namespace longreach
