#pragma once
// Results of a campaign as CSV (RFC 4180, numbers in the shortest form that gives the same number back): a
// row per cell in the order of the grid, a column per metric in the order of first appearance.
//
//   cell, experiment, seed, set.PATH of each setting, commit, config, metrics
//
// A cell without result has a row without metrics. Times differ between runs; they and the run time of each
// cell are in a separate file, NAME.times.csv.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

/// By cell number.
using CellResults = std::vector<std::optional<proto::CellRecord>>;

/// Throws std::runtime_error.
void write_results(const std::filesystem::path& file, const proto::CampaignRecord& record,
                   const CellResults& results);

/// "NAME.times.csv".
std::filesystem::path times_file(const std::filesystem::path& file);

/// Lists the cells without result on standard error, the first twenty by name. Returns their number.
std::size_t complain_of_missing(const Grid& grid, const CellResults& results);

}  // namespace longreach
