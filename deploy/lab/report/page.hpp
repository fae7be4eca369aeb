#pragma once
// The report as one HTML page that needs no other file, and as a table for a text in Markdown.

#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

struct ReportPicture {
  std::string title;
  std::string svg;
};

/// What one experiment gave.
struct ReportChapter {
  const Experiment* experiment = nullptr;
  std::string command;  // that repeats it
  std::string config;   // hash
  std::vector<Metric> metrics;
  std::vector<ReportPicture> pictures;
  std::string failure;  // why it gave nothing; empty: it did
};

struct ReportHead {
  std::string commit;
  std::string size;  // of the campaigns, in words
  std::uint64_t seed = 1;
};

std::string report_page(const ReportHead& head, const std::vector<ReportChapter>& chapters);

/// "| experiment | asks | answer |", one row a chapter that has an answer.
std::string report_table(const std::vector<ReportChapter>& chapters);

}  // namespace longreach
