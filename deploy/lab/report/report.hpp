#pragma once
// `longreach-lab report`: runs all experiments one after the other, writes the output of each to DIR/NAME,
// and writes DIR/index.html and DIR/results.md.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct ReportOptions {
  std::filesystem::path out;
  bool quick = false;  // run the experiments at small size instead of full size
  std::uint64_t seed = 1;
  std::vector<std::string> only;  // names of the experiments to run; empty: all
};

/// Runs the experiments and writes the report, with progress on standard error. Returns the number of
/// experiments that failed; the report contains the results of the others. Throws ConfigError for an unknown
/// name, and std::runtime_error if a file cannot be written.
int write_report(const ReportOptions& options);

}  // namespace longreach
