#pragma once
// The sentence that a report says of an experiment, with the figures of its metrics put in.

#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Three significant digits, without an exponent from 0.001 up to a million; 0 for zero.
std::string figure(double value);

/// `sentence` with {NAME} and {NAME*FACTOR} replaced by the figures of metrics. Throws std::invalid_argument
/// that names what is not a metric, is one of the machine (no two runs would say the same) or is no factor.
std::string answer(std::string_view sentence, const std::vector<Metric>& metrics);

}  // namespace longreach
