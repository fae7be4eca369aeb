#pragma once
// Writes the results of a fault campaign to faults.csv and faults.svg: the number of injections of each kind
// of fault, the number of activations of each guard, and the numbers of checks and violations of each
// invariant.

#include <filesystem>

#include "tests/faults/tally.hpp"

namespace longreach {

/// Writes the two files to `folder`. Throws std::runtime_error if a file cannot be written.
void write_faults(const std::filesystem::path& folder, const Tally& tally);

}  // namespace longreach
