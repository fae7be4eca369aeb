#pragma once
// The sentence of a report on an experiment, with the values of its metrics.

#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Three significant digits, without an exponent from 0.001 up to a million; 0 for zero.
std::string figure(double value);

/// Returns `sentence` with {NAME} and {NAME*FACTOR} replaced by values of metrics. Throws
/// std::invalid_argument that names an unknown metric, a metric of the machine (which differs between runs)
/// or an invalid factor.
std::string answer(std::string_view sentence, const std::vector<Metric>& metrics);

}  // namespace longreach
