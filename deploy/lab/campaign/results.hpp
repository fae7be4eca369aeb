#pragma once
// What a campaign gave, as CSV (RFC 4180, numbers in their shortest form that gives the same number back): a
// row a cell in the grid's order, a column a metric in the order of its first appearance.
//
//   cell, experiment, seed, set.PATH of each setting, commit, config, metrics
//
// A cell without result has a row without metrics. Times are not the same in every run: they, and what each
// cell took, have a file of their own beside it, NAME.times.csv.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

/// By the numbers of the cells.
using CellResults = std::vector<std::optional<proto::CellRecord>>;

/// Throws std::runtime_error.
void write_results(const std::filesystem::path& file, const proto::CampaignRecord& record,
                   const CellResults& results);

/// "NAME.times.csv".
std::filesystem::path times_file(const std::filesystem::path& file);

/// Tells on standard error which cells have no result, the first twenty by their names. Returns how many.
std::size_t complain_of_missing(const Grid& grid, const CellResults& results);

}  // namespace longreach
