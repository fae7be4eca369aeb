#pragma once
// Results of a campaign as CSV (RFC 4180; numbers in the shortest form that parses back to the same value):
// one row per cell in the order of the grid, and one column per metric in the order of first appearance.
//
//   cell, experiment, seed, set.PATH of each setting, commit, config, metrics
//
// A cell without a result has a row without metrics. Timing metrics vary from run to run, so they are
// written, together with the run time of each cell, to a separate file, NAME.times.csv.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

/// Results indexed by cell number.
using CellResults = std::vector<std::optional<proto::CellRecord>>;

/// Writes both files. Throws std::runtime_error.
void write_results(const std::filesystem::path& file, const proto::CampaignRecord& record,
                   const CellResults& results);

/// Returns "NAME.times.csv" for "NAME.csv".
std::filesystem::path times_file(const std::filesystem::path& file);

/// Reports the cells without a result on standard error, listing the first twenty. Returns their number.
std::size_t complain_of_missing(const Grid& grid, const CellResults& results);

}  // namespace longreach
