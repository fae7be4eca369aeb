#pragma once
// Fills in the sentence with which the report answers the question of an experiment.

#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Formats a value with three significant digits. Values between 0.001 and a million have no exponent; zero
/// is "0".
std::string figure(double value);

/// Returns `sentence` with {NAME} and {NAME*FACTOR} replaced by the values of the metrics. Throws a
/// std::invalid_argument that names the offending placeholder if the metric is unknown, if it depends on the
/// machine and thus differs between runs, or if the factor is invalid.
std::string answer(std::string_view sentence, const std::vector<Metric>& metrics);

}  // namespace longreach
