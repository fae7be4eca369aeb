#pragma once
// `longreach-lab report`: runs all experiments, one by one, into DIR/NAME, and writes DIR/index.html and
// DIR/results.md.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct ReportOptions {
  std::filesystem::path out;
  bool quick = false;  // small size of the experiments instead of full size
  std::uint64_t seed = 1;
  std::vector<std::string> only;  // names; empty: all
};

/// Prints its progress on standard error. Returns the number of failed experiments; the others are in the
/// report. Throws ConfigError for an unknown name, std::runtime_error if a file cannot be written.
int write_report(const ReportOptions& options);

}  // namespace longreach
