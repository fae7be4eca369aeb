#pragma once
// A completely validated campaign: every cell has an experiment and a valid configuration.

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

struct Plan {
  Grid grid;
  std::filesystem::path folder;      // of the grid: base of relative names in it
  proto::CampaignRecord record;      // identifies the campaign
  std::vector<std::string> configs;  // hash of the configuration of each combination
};

/// Reads a grid, protobuf text format of proto/campaign.proto, and configures every combination of settings.
/// Throws ConfigError that names file, line and problem.
Plan load_plan(const std::filesystem::path& file, const std::filesystem::path& deploy_folder);

/// Commit of the program. If the tree differed from it, the hash of the program is added.
std::string program_name();

/// Whether experiments run at full size, LONGREACH_FULL.
bool full_size();

}  // namespace longreach
