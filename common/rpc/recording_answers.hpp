#pragma once
// Status of the recording of a side for RPC and log, and start and stop of a recording for the backend of a
// side.

#include <string>
#include <variant>

#include "common/recording/side_recording.hpp"
#include "common/rpc/control_backend.hpp"

namespace longreach {

/// Leaves the status empty if there has been no recording.
void fill(proto::Status& status, const RecordingStatus& recording);
/// "FILE: 12.3 s, 4.5 MB", and the number of missing ticks.
std::string in_words(const RecordingStatus& recording);
/// Called by the recorder with the reason for the end, also after a requested stop.
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
