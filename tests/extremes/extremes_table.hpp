#pragma once
// Writes the results of the tests with extreme values as extremes.csv (with all messages) and extremes.svg (a
// table that shows the accuracy of each cell, coloured by outcome).

#include <filesystem>

#include "tests/extremes/extremes.hpp"

namespace longreach {

/// Writes both files. `results` has one element per row and cell. Throws std::runtime_error if a file cannot
/// be written.
void write_extremes(const std::filesystem::path& folder, const std::vector<ExtremeRow>& rows,
                    const std::vector<std::vector<ExtremeResult>>& results);

}  // namespace longreach
