#include "common/rpc/recording_answers.hpp"

#include <spdlog/spdlog.h>

namespace longreach {

void fill(proto::Status& status, const RecordingStatus& recording) {
  if (recording.file.empty()) return;
  proto::Recording& out = *status.mutable_recording();
  out.set_file(recording.file);
  out.set_running(recording.running);
  out.set_failed(recording.failed);
  out.set_ended(recording.ended);
  out.set_bytes(recording.bytes);
  out.set_seconds(recording.seconds);
  out.set_ticks_not_recorded(recording.ticks_not_recorded);
}

std::string in_words(const RecordingStatus& recording) {
  std::string out = fmt::format("{}: {:.1f} s, {:.1f} MB", recording.file, recording.seconds,
                                1e-6 * static_cast<double>(recording.bytes));
  if (recording.ticks_not_recorded > 0)
    out += fmt::format("; {} ticks are missing", recording.ticks_not_recorded);
  return out;
}

void log_end(const RecordingStatus& recording) {
  spdlog::log(recording.failed ? spdlog::level::warn : spdlog::level::info,
              "recording end file={} because=\"{}\" seconds={:.1f} bytes={} ticks_not_recorded={}",
              recording.file, recording.ended, recording.seconds, recording.bytes,
              recording.ticks_not_recorded);
}

void log_start(const RecordingStatus& recording) { spdlog::info("recording begin file={}", recording.file); }

}  // namespace longreach
