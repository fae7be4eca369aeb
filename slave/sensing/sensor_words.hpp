#pragma once
// Descriptions of the zero and the touch threshold of the force sensor, for status and log.

#include <string>

#include "slave/sensing/bias_tracker.hpp"

namespace longreach {

/// Returns the threshold, noise and bias, or what is still needed to zero the sensor for the first time;
/// empty if the thresholds are configured.
std::string in_words(const SensorZero& zero);
/// Returns the reason why contacts may be missed or falsely detected, and a remedy; empty if there is no
/// problem.
std::string sensor_warning(const SensorZero& zero);

}  // namespace longreach
