#pragma once
// What RPC and log say of a side's recording, and its start and stop as the backend of a side answers them.

#include <string>
#include <variant>

#include "common/recording/side_recording.hpp"
#include "common/rpc/control_backend.hpp"

namespace longreach {

/// Nothing is filled in while there has been no recording.
void fill(proto::Status& status, const RecordingStatus& recording);
/// "FILE: 12.3 s, 4.5 MB", and how many ticks it lacks.
std::string in_words(const RecordingStatus& recording);
/// Called by the recorder: why it ended, also when that was asked for.
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
