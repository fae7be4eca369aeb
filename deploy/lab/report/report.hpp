#pragma once
// `longreach-lab report`: every experiment, one after the other, into DIR/NAME, and of all of them
// DIR/index.html and DIR/results.md.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct ReportOptions {
  std::filesystem::path out;
  bool quick = false;  // the experiments' small size instead of their full one
  std::uint64_t seed = 1;
  std::vector<std::string> only;  // names; empty: all
};

/// Says on standard error how far it is. Returns how many experiments failed; the others are in the report.
/// Throws ConfigError for a name that is none, std::runtime_error when a file cannot be written.
int write_report(const ReportOptions& options);

}  // namespace longreach
