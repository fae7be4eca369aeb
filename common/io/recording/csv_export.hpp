#pragma once
// A recording as tables: a CSV file a topic, a row a message, a column a number. Reads the schemas of the
// file, so that recordings of any version can be exported; numbers with as many digits as they have.

#include <cstdint>
#include <filesystem>
#include <vector>

namespace longreach {

struct CsvTable {
  std::filesystem::path file;
  std::uint64_t rows = 0;
};

struct CsvExport {
  std::vector<CsvTable> tables;
  bool whole = false;  // false: the recording is cut, or still being written
};

/// Into `folder`, which is made: TOPIC.csv each, '/' as '_'. First columns: t_s since the first message of
/// the recording, log_time_ns. What is absent is an empty cell, a repeated field a text. Throws
/// RecordingError, also, before anything is made, for a recording without a whole message.
CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder);

}  // namespace longreach
