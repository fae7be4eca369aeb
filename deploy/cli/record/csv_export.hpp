#pragma once
// Exports a recording as tables, with one CSV file per topic, one row per message and one column per number.
// It uses the schemas in the recording, so recordings of any version can be exported. Numbers are printed in
// full precision.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct CsvTable {
  std::filesystem::path file;
  std::uint64_t rows = 0;
};

struct CsvExport {
  std::vector<CsvTable> tables;
  std::vector<std::string> skipped{};  // topics that are not encoded as protobuf, with the reason
  std::vector<std::string> damaged{};  // topics and messages that were skipped because they are damaged
  double last_s = 0.0;                 // t_s of the last message
  bool whole = false;                  // false if the recording is truncated or still being written
};

/// Creates `folder` with one file TOPIC.csv per topic ('/' is replaced by '_'). The first columns are t_s,
/// the time since `zero_ns` (0: since the first message of the recording), and log_time_ns, the Unix time,
/// which is comparable across recordings. Missing values become empty cells, and repeated fields become text.
/// Existing files are not overwritten. Throws RecordingError after removing the tables and the folder that it
/// created.
CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder,
                     std::uint64_t zero_ns = 0);

}  // namespace longreach
