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

/// Exit status: 0, or 3 when there was no contact. Throws ConfigError for an experiment or a setting that is
/// none, or that the experiment does not use.
int run(const RunOptions& options);

void list_experiments();

}  // namespace longreach
