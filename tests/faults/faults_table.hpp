#pragma once
// Writes the results of a fault campaign as faults.csv and faults.svg: kinds of fault and the number of
// injections, guards and the number of activations, invariants and the numbers of checks and violations.

#include <filesystem>

#include "tests/faults/tally.hpp"

namespace longreach {

/// Throws std::runtime_error if a file cannot be written.
void write_faults(const std::filesystem::path& folder, const Tally& tally);

}  // namespace longreach
