#pragma once
// Fills in the values in the sentence that answers the question of an experiment in the report.

#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Formats a value with three significant digits. Values between 0.001 and a million are written without an
/// exponent; zero is written as "0".
std::string figure(double value);

/// Returns `sentence` with {NAME} and {NAME*FACTOR} replaced by the values of the metrics. Throws a
/// std::invalid_argument that names the offending placeholder if the metric is unknown, if it depends on the
/// machine and thus varies from run to run, or if the factor is invalid.
std::string answer(std::string_view sentence, const std::vector<Metric>& metrics);

}  // namespace longreach
