#pragma once
// A campaign that has been checked from end to end: every cell has an experiment and a valid configuration.

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

struct Plan {
  Grid grid;
  std::filesystem::path folder;      // of the grid: names in it count from here
  proto::CampaignRecord record;      // names the campaign
  std::vector<std::string> configs;  // hash of the configuration of each combination
};

/// Reads a grid, protobuf text format of proto/campaign.proto, and configures every combination of settings.
/// Throws ConfigError that names file, line and what is wrong there.
Plan load_plan(const std::filesystem::path& file, const std::filesystem::path& deploy_folder);

/// Commit that the program was built from. A tree that differed from it has a commit that says nothing: then
/// the hash of the program is added.
std::string program_name();

/// Whether experiments run in their full size, LONGREACH_FULL.
bool full_size();

}  // namespace longreach
