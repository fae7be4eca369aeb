#pragma once
// Formats the report as a self-contained HTML page and as a Markdown table.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

struct ReportPicture {
  std::string title;
  std::string svg;
};

/// Results of one experiment.
struct ReportChapter {
  const Experiment* experiment = nullptr;
  std::string command;  // command line that reproduces the results
  std::string config;   // hash of the configuration
  std::vector<Metric> metrics;
  std::vector<ReportPicture> pictures;
  std::string failure;  // reason why there are no results; empty if the experiment succeeded
};

struct ReportHead {
  std::string commit;
  std::string size;  // size of the campaigns in words
  std::uint64_t seed = 1;
};

std::string report_page(const ReportHead& head, const std::vector<ReportChapter>& chapters);

/// Returns a table "| experiment | question | answer |" with one row per chapter that has an answer.
std::string report_table(const std::vector<ReportChapter>& chapters);

}  // namespace longreach
