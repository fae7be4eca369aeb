#pragma once
// A validated campaign: the experiment of every cell exists, and its configuration is valid.

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/lab/campaign/grid.hpp"

namespace longreach {

struct Plan {
  Grid grid;
  std::filesystem::path folder;      // folder of the grid file, to which file names in the grid are relative
  proto::CampaignRecord record;      // identifies the campaign
  std::vector<std::string> configs;  // hash of the configuration for each combination
};

/// Reads a grid in the text format of proto/campaign.proto and builds the configuration for every combination
/// of settings. Throws a ConfigError that names the file, the line and the problem.
Plan load_plan(const std::filesystem::path& file, const std::filesystem::path& deploy_folder);

/// Returns the commit from which the program was built. If the working tree was modified, a hash of the
/// executable is appended.
std::string program_name();

/// Returns whether experiments run at full size, which is the case if LONGREACH_FULL is set in the
/// environment.
bool full_size();

}  // namespace longreach
