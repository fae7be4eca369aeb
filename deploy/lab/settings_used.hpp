#pragma once
// Which settings an experiment uses. One that it does not use is refused: a run with it would be the run
// without it, and a sweep over it a table of equal rows.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

/// Whether the experiment depends on what `path` of `--set PATH=VALUE` sets, by Experiment::uses; the longest
/// path that holds the field decides. A file counts as what it describes, `profile` as the delay of the link.
bool uses_setting(const Experiment& experiment, const std::string& path);

/// Throws ConfigError that names the first setting "PATH=VALUE" that the experiment does not use.
void refuse_unused(const Experiment& experiment, const std::vector<std::string>& settings);

/// The sentence of that error.
std::string unused_sentence(const Experiment& experiment, const std::string& path);

}  // namespace longreach
