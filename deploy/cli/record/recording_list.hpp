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
  double seconds = 0.0;   // from the first message to the last
  std::string began{};    // start time according to the file, e.g. 20261122T204500Z
  std::string side{};     // side according to the file
  bool whole = false;     // false if the file is truncated or still being written
  std::string trouble{};  // why the file cannot be read; empty if it can
};

/// Lists the files *.mcap in a folder, sorted by name. The list is empty if the folder does not exist. Throws
/// RecordingError if it cannot be read.
std::vector<ListedRecording> list_recordings(const std::filesystem::path& folder);

/// Finds recordings by name. `name` is either the path of a file or the name of recordings in `folder`, where
/// NAME, NAME.mcap, and then NAME-master.mcap and NAME-slave.mcap are tried. If there is no such recording,
/// throws a RecordingError that lists the searched folders.
std::vector<std::filesystem::path> find_recordings(const std::filesystem::path& folder,
                                                   const std::string& name);

}  // namespace longreach
