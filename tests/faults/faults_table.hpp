#pragma once
// Writes the results of a fault campaign to faults.csv and faults.svg: each kind of fault with its number of
// injections, each guard with its number of activations, and each invariant with its numbers of checks and
// violations.

#include <filesystem>

#include "tests/faults/tally.hpp"

namespace longreach {

/// Writes the two files to `folder`. Throws std::runtime_error if a file cannot be written.
void write_faults(const std::filesystem::path& folder, const Tally& tally);

}  // namespace longreach
