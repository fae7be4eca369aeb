#pragma once
// Settings that an experiment uses. Another setting is refused, because it would not change the run, and the
// rows of a sweep over it would be equal.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Returns whether the experiment depends on the field that `path` of `--set PATH=VALUE` sets, by
/// Experiment::uses; the longest path that contains the field decides. A file counts as its content,
/// `profile` as the delay of the link.
bool uses_setting(const Experiment& experiment, const std::string& path);

/// Throws ConfigError that names the first setting "PATH=VALUE" that the experiment does not use.
void refuse_unused(const Experiment& experiment, const std::vector<std::string>& settings);

/// The text of that error.
std::string unused_sentence(const Experiment& experiment, const std::string& path);

}  // namespace longreach
