#pragma once
// Makes the recordings of a side, one at a time. Owns the record buffer and the recorder, and passes the
// buffer to the loop. Only one thread at a time, and never the loop, may use an object; only status() is
// thread-safe.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "common/link/header.hpp"
#include "common/loop/side_clock.hpp"
#include "common/recording/build_name.hpp"
#include "common/recording/recorder.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/recording_folder.hpp"

namespace longreach {

/// Returns the current time of the loop's clock.
inline Time recording_now() { return boottime_now(); }

/// Folder for the recordings of a side, and the seed of the side.
struct RecordingPlace {
  std::string folder{};  // empty for the default folder
  std::uint64_t seed = 0;
};

template <class RecordType>
class SideRecording {
 public:
  struct Request {
    std::filesystem::path file;
    double max_mb = kRecordMaxMb;
    double rate_hz = 1000.0;
    std::uint64_t seed = 0;
    std::uint32_t config_number = 0;
    std::string config_text;
  };

  SideRecording(std::string side, std::function<void(const RecordingStatus&)> ended)
      : side_(std::move(side)), ended_(std::move(ended)) {}

  /// Starts a recording. attach(buffer) passes the buffer to the loop and returns false if the loop did not
  /// respond. Throws RecordingError.
  template <class Attach>
  void start(const Request& request, const Attach& attach) {
    if (status().running)
      throw RecordingError(status().file +
                           " is already being recorded; stop it with `longreach record stop`");
    if (record_buffer_ && !attach(nullptr)) throw RecordingError(kNoAnswer);
    drop();
    auto record_buffer = make_record_buffer(request);
    record_buffer->add_config(recording_now(), request.config_number, request.config_text);
    auto recorder = std::make_unique<Recorder>(
        RecorderOptions{request.file, static_cast<std::uint64_t>(1e6 * request.max_mb), facts(request),
                        ended_},
        *record_buffer);
    keep(std::move(record_buffer), std::move(recorder));
    if (!attach(record_buffer_.get())) {
      recorder_->stop();
      throw RecordingError(kNoAnswer);
    }
  }

  /// Stops the recording. Throws RecordingError if none is in progress.
  template <class Attach>
  RecordingStatus stop(const Attach& attach) {
    const RecordingStatus before = status();
    if (!before.running)
      throw RecordingError("no recording is in progress" +
                           (before.ended.empty() ? "" : "; " + before.file + ": " + before.ended));
    (void)attach(nullptr);
    recorder_->stop();
    return status();
  }

  void add_config(std::uint32_t number, const std::string& text) {
    if (record_buffer_) record_buffer_->add_config(recording_now(), number, text);
  }
  void add_event(const std::string& text) {
    if (record_buffer_) record_buffer_->add_event(recording_now(), text);
  }

  /// Returns the status of the current or last recording. Its `file` is empty if there was none.
  [[nodiscard]] RecordingStatus status() const {
    const std::lock_guard lock(mutex_);
    return recorder_ ? recorder_->status() : RecordingStatus{};
  }

 private:
  static constexpr const char* kNoAnswer = "the control loop did not respond within 1 s; try again";

  static std::unique_ptr<RecordType> make_record_buffer(const Request& request) {
    try {
      return std::make_unique<RecordType>(request.rate_hz, monotonic_to_unix());
    } catch (const std::bad_alloc&) {
      throw RecordingError("there is not enough memory for a recording");
    }
  }

  [[nodiscard]] TextMap facts(const Request& request) const {
    return {{"side", side_},
            {"version", std::string(build_version())},
            {"wire", std::to_string(kWireVersion)},
            {"commit", std::string(build_commit())},
            {"seed", std::to_string(request.seed)},
            {"began", recording_name_now()}};
  }

  /// Replaces buffer and recorder. The previous recorder is ended outside of the lock, because the disk may
  /// be slow.
  void keep(std::unique_ptr<RecordType> record_buffer, std::unique_ptr<Recorder> recorder) {
    {
      const std::lock_guard lock(mutex_);
      recorder_.swap(recorder);
      record_buffer_.swap(record_buffer);
    }
    recorder.reset();  // must end before its buffer
  }
  void drop() { keep(nullptr, nullptr); }

  std::string side_;
  std::function<void(const RecordingStatus&)> ended_;
  mutable std::mutex mutex_;  // protects the pointers; never locked by the loop
  std::unique_ptr<RecordType> record_buffer_;
  std::unique_ptr<Recorder> recorder_;  // ends before its buffer
};

}  // namespace longreach
