#pragma once
// The recordings in a folder, for whoever wants to know what there is.

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
  std::string began{};    // as the file says, e.g. 20261122T204500Z
  std::string side{};     // likewise
  bool whole = false;     // false: cut, or still being written
  std::string trouble{};  // why it cannot be read; empty: it can
};

/// Files *.mcap, by name. A folder that is not there has none. Throws RecordingError for one that cannot be
/// read.
std::vector<ListedRecording> list_recordings(const std::filesystem::path& folder);

/// What `name` means: a file; else NAME, NAME.mcap, or NAME-master.mcap and NAME-slave.mcap in `folder`.
/// Throws RecordingError that says where it looked.
std::vector<std::filesystem::path> find_recordings(const std::filesystem::path& folder,
                                                   const std::string& name);

}  // namespace longreach
