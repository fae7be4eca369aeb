#pragma once
// What a campaign of faults gave, as faults.csv and faults.svg: kinds and how often they were injected,
// guards and how often they acted, invariants and how often they were judged and violated.

#include <filesystem>

#include "tests/faults/tally.hpp"

namespace longreach {

/// Throws std::runtime_error when a file cannot be written.
void write_faults(const std::filesystem::path& folder, const Tally& tally);

}  // namespace longreach
