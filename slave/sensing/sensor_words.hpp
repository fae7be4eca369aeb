#pragma once
// Zero and touch threshold of the force sensor, for status and log.

#include <string>

#include "slave/sensing/bias_tracker.hpp"

namespace longreach {

/// Threshold, noise and bias, or what is missing for them; empty where they are as configured.
std::string in_words(const SensorZero& zero);
/// Why contacts may be missed or invented, and what to do; empty: no problem.
std::string sensor_warning(const SensorZero& zero);

}  // namespace longreach
