#pragma once
// Determines which settings an experiment uses. Other settings are rejected, because they would have no
// effect: all rows of a sweep over such a setting would be equal.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Returns whether the experiment depends on the field that `--set PATH=VALUE` sets, according to
/// Experiment::uses. If several paths in `uses` contain the field, the longest one takes precedence. A setting
/// that names a file stands for the fields in that file, and `profile` stands for the delay of the link.
bool uses_setting(const Experiment& experiment, const std::string& path);

/// Throws a ConfigError that names the first of the settings ("PATH=VALUE") that the experiment does not use.
void refuse_unused(const Experiment& experiment, const std::vector<std::string>& settings);

/// Returns the message of this error.
std::string unused_sentence(const Experiment& experiment, const std::string& path);

}  // namespace longreach
