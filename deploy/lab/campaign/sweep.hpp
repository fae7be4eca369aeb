#pragma once
// `longreach-lab sweep` runs a campaign, each cell in a separate process; completed cells are not repeated.
// `longreach-lab merge` combines the results of several shards.

#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct SweepOptions {
  std::filesystem::path file;
  std::filesystem::path out;  // empty: out/NAME, where NAME is the name of the grid file
  int jobs = 0;               // number of parallel jobs; 0: one per processor
  std::string shard = "1/1";  // I/N, with I starting at 1: every Nth cell, starting with the Ith
  bool quiet = false;
};

/// Returns the exit status: 0 if every cell of the shard is complete, 1 if some failed, 3 if some had no
/// contact, or 128 + signal if it was stopped. A ConfigError is thrown only before the first cell runs.
int sweep(const SweepOptions& options);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;  // CSV file; empty: results.csv in the first folder
};

/// Returns the exit status: 0 if every cell has a result, 1 if some are missing. Throws ConfigError if the
/// folders belong to different campaigns.
int merge(const MergeOptions& options);

/// A shard of a campaign, written "I/N" with I from 1 to N. parse_shard throws ConfigError if the text is
/// invalid.
struct Shard {
  std::size_t index = 1, count = 1;
};
Shard parse_shard(const std::string& text);

}  // namespace longreach
