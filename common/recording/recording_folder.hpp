#pragma once
// Location and names of the recordings of a side.

#include <filesystem>
#include <string>

namespace longreach {

constexpr double kRecordMaxMb = 4096.0;  // default size of a recording: about three hours at 1 kHz

/// Returns $XDG_STATE_HOME/longreach/recordings, else ~/.local/state/longreach/recordings. Throws
/// RecordingError.
std::filesystem::path default_recordings();

/// Throws RecordingError for a name that is not valid as part of a file name.
void check_recording_name(const std::string& name);

/// Returns FOLDER/NAME-SIDE.mcap, and creates the folder if it does not exist. Throws RecordingError, also
/// for an invalid name: letters, digits and . _ -, at most 100, not starting with a dot or a dash.
std::filesystem::path recording_path(const std::filesystem::path& folder, const std::string& name,
                                     const std::string& side);

/// Present time in the form 20261122T204500Z.
std::string recording_name_now();

}  // namespace longreach
