#pragma once
// Descriptions of the zero and the touch threshold of the force sensor, for status and log.

#include <string>

#include "slave/sensing/bias_tracker.hpp"

namespace longreach {

/// Returns threshold, noise and bias, or what is missing for the zero; empty if the thresholds are
/// configured.
std::string in_words(const SensorZero& zero);
/// Returns why contacts may be missed or falsely detected, and a remedy; empty: no problem.
std::string sensor_warning(const SensorZero& zero);

}  // namespace longreach
