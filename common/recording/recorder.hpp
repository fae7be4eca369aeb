#pragma once
// Writes a record buffer to a file in its own thread, until it is stopped, the file reaches its maximum size
// or the disk is full. It polls the buffer: the loop neither waits for it nor wakes it. Data older than a
// second has been passed to the system, so the recording of a killed program lacks at most its last second.

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
  bool failed = false;      // it ended because of an error
  std::string ended;        // why it ended; empty: it is running
  std::uint64_t bytes = 0;  // size of the file so far
  double seconds = 0.0;     // since its start; after the end, the total
  std::uint64_t ticks_not_recorded = 0;
};

struct RecorderOptions {
  std::filesystem::path file;
  std::uint64_t max_bytes = 0;
  TextMap facts{};                                      // metadata of the file
  std::function<void(const RecordingStatus&)> ended{};  // called once, in the recorder's thread
};

class Recorder {
 public:
  /// Creates the file with its metadata. Throws RecordingError. `record_buffer` outlives the recorder.
  Recorder(const RecorderOptions& options, RecordBuffer& record_buffer);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes the remaining records and ends the file.
  void stop();
  [[nodiscard]] RecordingStatus status() const;

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  /// Returns why it must end now; empty: it continues.
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
