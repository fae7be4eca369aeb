#pragma once
// Lists the recordings in a folder.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct ListedRecording {
  std::filesystem::path file;
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
  double seconds = 0.0;   // between the first message and the last
  std::string began{};    // as stated in the file, e.g. 20261122T204500Z
  std::string side{};     // likewise
  bool whole = false;     // false: truncated, or still being written
  std::string trouble{};  // why it cannot be read; empty: it can be read
};

/// Lists the files *.mcap by name. A missing folder has none. Throws RecordingError if the folder cannot be
/// read.
std::vector<ListedRecording> list_recordings(const std::filesystem::path& folder);

/// Resolves `name`: a file; else NAME, NAME.mcap, or NAME-master.mcap and NAME-slave.mcap in `folder`. Throws
/// RecordingError that lists the searched folders.
std::vector<std::filesystem::path> find_recordings(const std::filesystem::path& folder,
                                                   const std::string& name);

}  // namespace longreach
