#pragma once
// Reports the status of a side's recording over RPC and in the log, and starts and stops recordings for the
// backend of that side.

#include <string>
#include <variant>

#include "common/recording/side_recording.hpp"
#include "common/rpc/control_backend.hpp"

namespace longreach {

/// Fills in the status of the recording; leaves it empty if there was none.
void fill(proto::Status& status, const RecordingStatus& recording);
/// Returns "FILE: 12.3 s, 4.5 MB", and the number of missing ticks if there are any.
std::string in_words(const RecordingStatus& recording);
/// Logs why a recording ended. Called at the end of every recording, whatever the reason.
void log_end(const RecordingStatus& recording);
void log_start(const RecordingStatus& recording);

template <class RecordType, class Attach>
std::variant<std::string, Refusal> start_recording(SideRecording<RecordType>& recording,
                                                   typename SideRecording<RecordType>::Request request,
                                                   const std::string& folder, const std::string& name,
                                                   const std::string& side, const Attach& attach) {
  try {
    request.file =
        recording_path(folder.empty() ? default_recordings() : std::filesystem::path(folder), name, side);
    recording.start(request, attach);
  } catch (const RecordingError& e) {
    return Refusal{Refusal::Kind::kPrecondition, e.what()};
  }
  log_start(recording.status());
  return recording.status().file;
}

template <class RecordType, class Attach>
std::variant<std::string, Refusal> stop_recording(SideRecording<RecordType>& recording,
                                                  const Attach& attach) {
  try {
    return in_words(recording.stop(attach));
  } catch (const RecordingError& e) {
    return Refusal{Refusal::Kind::kPrecondition, e.what()};
  }
}

}  // namespace longreach
