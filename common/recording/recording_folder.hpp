#pragma once
// Folder and names of the recordings of a side.

#include <filesystem>
#include <string>

namespace longreach {

constexpr double kRecordMaxMb = 4096.0;  // default maximum size of a recording, about three hours at 1 kHz

/// Returns $XDG_STATE_HOME/longreach/recordings, or ~/.local/state/longreach/recordings if the variable is
/// not set. Throws RecordingError if neither is known.
std::filesystem::path default_recordings();

/// Throws RecordingError if `name` is not a valid part of a file name.
void check_recording_name(const std::string& name);

/// Returns FOLDER/NAME-SIDE.mcap, and creates the folder if it does not exist. Throws RecordingError if this
/// fails or the name is invalid. A name has at most 100 characters (letters, digits, '.', '_' or '-') and
/// does not start with a dot or a dash.
std::filesystem::path recording_path(const std::filesystem::path& folder, const std::string& name,
                                     const std::string& side);

/// Returns the current time in the form 20261122T204500Z.
std::string recording_name_now();

}  // namespace longreach
