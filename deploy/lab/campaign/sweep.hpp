#pragma once
// `longreach-lab sweep`: runs a campaign, each cell in a separate process; completed cells are not repeated.
// `longreach-lab merge`: joins the results of several shards.

#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct SweepOptions {
  std::filesystem::path file;
  std::filesystem::path out;  // empty: out/NAME of the file
  int jobs = 0;               // in parallel; 0: one per processor
  std::string shard = "1/1";  // I/N: the cells I, I + N, I + 2 N, ..., I from 1
  bool quiet = false;
};

/// Exit status: 0 if every cell of the shard is done, 1 if some failed, 3 if some had no contact, 128 +
/// signal if stopped. Throws ConfigError before the first cell runs.
int sweep(const SweepOptions& options);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;  // CSV file; empty: results.csv in the first folder
};

/// Exit status: 0 if every cell has a result, 1 if some are missing. Throws ConfigError for folders of
/// different campaigns.
int merge(const MergeOptions& options);

/// "I/N" with I from 1 to N. Throws ConfigError.
struct Shard {
  std::size_t index = 1, count = 1;
};
Shard parse_shard(const std::string& text);

}  // namespace longreach
