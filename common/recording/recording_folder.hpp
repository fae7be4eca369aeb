#pragma once
// Where a side keeps its recordings, and how they are called.

#include <filesystem>
#include <string>

namespace longreach {

constexpr double kRecordMaxMb = 4096.0;  // default size of a recording: about three hours at 1 kHz

/// $XDG_STATE_HOME/longreach/recordings, else ~/.local/state/longreach/recordings. Throws RecordingError.
std::filesystem::path default_recordings();

/// Throws RecordingError for a name that is no part of a file's name.
void check_recording_name(const std::string& name);

/// FOLDER/NAME-SIDE.mcap; makes the folder when there is none. Throws RecordingError, also for a name that is
/// none: letters, digits and . _ -, at most 100, not beginning with a dot or a dash.
std::filesystem::path recording_path(const std::filesystem::path& folder, const std::string& name,
                                     const std::string& side);

/// Now as 20261122T204500Z.
std::string recording_name_now();

}  // namespace longreach
