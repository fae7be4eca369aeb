#pragma once
// `longreach-lab sweep`: a campaign, cell by cell, each in a process of its own; what is done is not done
// again. `longreach-lab merge`: what several shards gave, as one.

#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct SweepOptions {
  std::filesystem::path file;
  std::filesystem::path out;  // empty: out/NAME of the file
  int jobs = 0;               // at a time; 0: one a processor
  std::string shard = "1/1";  // I/N: the cells I, I + N, I + 2 N, ..., I from 1
  bool quiet = false;
};

/// Exit status: 0 when every cell of the shard is done, 1 when some failed, 3 when some were without contact,
/// 128 + signal when stopped. Throws ConfigError before the first cell runs.
int sweep(const SweepOptions& options);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;  // CSV file; empty: results.csv in the first folder
};

/// Exit status: 0 when every cell is there, 1 when some are missing. Throws ConfigError for folders that do
/// not belong together.
int merge(const MergeOptions& options);

/// "I/N" with I from 1 to N. Throws ConfigError.
struct Shard {
  std::size_t index = 1, count = 1;
};
Shard parse_shard(const std::string& text);

}  // namespace longreach
