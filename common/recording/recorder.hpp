#pragma once
// Writes a tape into a file, in a thread of its own, until it is told to stop, the file has its largest size
// or the disk is full. It polls the tape: the loop neither waits for it nor wakes it. What is older than a
// second is with the system, so a program that is killed leaves a recording that lacks its last second at
// most.

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
  bool failed = false;      // it ended because it had to
  std::string ended;        // why it ended, in words; empty: it runs
  std::uint64_t bytes = 0;  // of the file so far
  double seconds = 0.0;     // since its start; once ended, until then
  std::uint64_t ticks_not_recorded = 0;
};

struct RecorderOptions {
  std::filesystem::path file;
  std::uint64_t max_bytes = 0;
  TextMap facts{};                                      // what the file says about itself
  std::function<void(const RecordingStatus&)> ended{};  // called once, in the recorder's thread
};

class Recorder {
 public:
  /// Makes the file, with what it says about itself. Throws RecordingError. `tape` outlives the recorder.
  Recorder(const RecorderOptions& options, RecordBuffer& record_buffer);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes what the tape still holds and ends the file.
  void stop();
  [[nodiscard]] RecordingStatus status() const;

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  /// Why it has to end now; empty: it goes on.
  [[nodiscard]] std::string trouble() const;
  void publish();
  void end(const std::string& why, bool failed);

  RecorderOptions options_;
  RecordBuffer& record_buffer_;
  RecordingFile file_;
  McapWriter writer_;
  Clock::time_point began_ = Clock::now();
  mutable std::mutex mutex_;  // never the loop
  std::condition_variable wake_;
  bool stopping_ = false;
  RecordingStatus status_{};
  std::thread thread_;
};

}  // namespace longreach
