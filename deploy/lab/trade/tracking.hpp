#pragma once
// Whole runs of the laboratory for `trade`: how well the tool follows the hand, and how right a wall feels.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// The hand moves to and fro in three dimensions for a minute, up to 20 mm/s, in free space; the tool is
/// compared with what was commanded one link delay before.
struct Tracking {
  double error_rms_m = 0.0;
  double late_s = 0.0;              // delay of the best fit, beyond that of the link
  double bent_rms_m = 0.0;          // what is left of the error then
  double roughness_m_per_s2 = 0.0;  // acceleration of the tool, rms; that of the hand is 0.02
  double kbit_per_s = 0.0;          // commands, headers counted
  double cost_us = 0.0;             // of both sides and the simulation, a millisecond of virtual time
};
/// `settings`: PATH=VALUE, beyond those of the run; over `analog` unless they name a profile.
Tracking track(const ExperimentRun& run, std::vector<std::string> settings);

/// The experiment `touch` over the same link, with some seeds.
struct Touched {
  double stiffness_error = 0.0;   // the worst of them
  double return_bit_per_s = 0.0;  // their mean
};
Touched touched(const ExperimentRun& run, std::vector<std::string> settings);

}  // namespace longreach
