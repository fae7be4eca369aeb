#pragma once
// The table of extremes as extremes.csv (every message) and extremes.svg (cells coloured by outcome, the
// accuracy in them).

#include <filesystem>

#include "tests/extremes/extremes.hpp"

namespace longreach {

/// `results` as `rows` and their cells. Throws std::runtime_error when a file cannot be written.
void write_extremes(const std::filesystem::path& folder, const std::vector<ExtremeRow>& rows,
                    const std::vector<std::vector<ExtremeResult>>& results);

}  // namespace longreach
