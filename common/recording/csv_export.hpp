#pragma once
// Exports a recording as tables: a CSV file per topic, a row per message, a column per number. It uses the
// schemas in the file, so that recordings of any version can be exported; numbers keep all their digits.

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
  std::vector<std::string> skipped{};  // topics that are not protobuf, with the reason
  std::vector<std::string> damaged{};  // topics and messages that were skipped because they cannot be read
  double last_s = 0.0;                 // t_s of the last message
  bool whole = false;                  // false: the recording is truncated, or still being written
};

/// Creates `folder` with one TOPIC.csv per topic, '/' replaced by '_'. First columns: t_s since `zero_ns` (0:
/// the first message of the recording), log_time_ns (Unix time, comparable across recordings). A missing
/// value is an empty cell, a repeated field a text. Existing files are not overwritten. Throws
/// RecordingError, and then removes the tables and the folder that it created.
CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder,
                     std::uint64_t zero_ns = 0);

}  // namespace longreach
