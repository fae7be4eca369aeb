#pragma once
// A recording as tables: a CSV file a topic, a row a message, a column a number. Reads the schemas of the
// file, so that recordings of any version can be exported; numbers with as many digits as they have.

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
  std::vector<std::string> damaged{};  // what was left out: topics and messages that cannot be read
  double last_s = 0.0;                 // t_s of the last message
  bool whole = false;                  // false: the recording is cut, or still being written
};

/// Into `folder`, which is made: TOPIC.csv each, '/' as '_'. First columns: t_s since `zero_ns` (0: the first
/// message of the recording), log_time_ns (Unix time, the same for every recording). What is absent is an
/// empty cell, a repeated field a text. Nothing is overwritten. Throws RecordingError, and then no table and
/// no folder that was made for one is left.
CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder,
                     std::uint64_t zero_ns = 0);

}  // namespace longreach
