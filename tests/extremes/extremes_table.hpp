#pragma once
// Writes the table of extremes as extremes.csv (with all messages) and extremes.svg (cells coloured by
// outcome, with their accuracy).

#include <filesystem>

#include "tests/extremes/extremes.hpp"

namespace longreach {

/// Writes `results` as rows with their cells. Throws std::runtime_error if a file cannot be written.
void write_extremes(const std::filesystem::path& folder, const std::vector<ExtremeRow>& rows,
                    const std::vector<std::vector<ExtremeResult>>& results);

}  // namespace longreach
