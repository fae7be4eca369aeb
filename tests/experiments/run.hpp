#pragma once
// `longreach-lab run` and `list`: one experiment, its metrics printed.

#include <cstdint>
#include <string>
#include <vector>

namespace longreach {

struct RunOptions {
  std::string name;
  std::uint64_t seed = 1;
  bool seeded = false;   // --seed was given
  std::string schedule;  // of faults, a file
  std::string seeds;     // likewise, FIRST:COUNT
  std::vector<std::string> settings;
  std::string out;
  bool record = false;
  bool quiet = false;
};

/// Throws ConfigError for an experiment or a setting that is none.
void run(const RunOptions& options);

void list_experiments();

}  // namespace longreach
