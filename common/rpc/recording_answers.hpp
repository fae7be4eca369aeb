#pragma once
// Reports the status of a side's recording over RPC and in the log.

#include <string>

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

}  // namespace longreach
