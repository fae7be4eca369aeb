#pragma once
// Writes the content of a record buffer to a file in its own thread, until it is stopped, the file reaches
// its maximum size or the disk is full. It polls the buffer, so the loop neither waits for the recorder nor
// wakes it. Data is passed to the operating system within a second, so the recording of a killed program
// lacks at most the last second.

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/recording/record_buffer.hpp"

namespace longreach {

struct RecordingStatus {
  std::string file;
  bool running = false;
  bool failed = false;      // the recording ended because of an error
  std::string ended;        // reason for the end; empty while it is running
  std::uint64_t bytes = 0;  // size of the file so far
  double seconds = 0.0;     // duration so far; after the end, the total duration
  std::uint64_t ticks_not_recorded = 0;
};

struct RecorderOptions {
  std::filesystem::path file;
  std::uint64_t max_bytes = 0;
  TextMap facts{};                                      // metadata of the file
  std::function<void(const RecordingStatus&)> ended{};  // called once at the end, in the recorder's thread
};

class Recorder {
 public:
  /// Creates the file with its metadata. `record_buffer` must outlive the recorder. Throws RecordingError.
  Recorder(const RecorderOptions& options, RecordBuffer& record_buffer);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes the remaining records and completes the file.
  void stop();
  [[nodiscard]] RecordingStatus status() const;

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  /// Returns why the recording must end now, or an empty string.
  [[nodiscard]] std::string trouble() const;
  void publish();
  void end(const std::string& why, bool failed);

  RecorderOptions options_;
  RecordBuffer& record_buffer_;
  RecordingFile file_;
  McapWriter writer_;
  Clock::time_point began_ = Clock::now();
  mutable std::mutex mutex_;  // never locked by the loop
  std::condition_variable wake_;
  bool stopping_ = false;
  RecordingStatus status_{};
  std::thread thread_;
};

}  // namespace longreach
