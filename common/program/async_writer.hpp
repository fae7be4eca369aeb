#pragma once
// Writes text to a terminal, pipe or file whose reader may stall. A separate thread writes; the caller never
// waits. At most `bytes_max` are queued, always including the newest text; the oldest is dropped and counted.
// Only whole texts are written: a text that was started is completed.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

namespace longreach {

class AsyncWriter {
 public:
  /// Returns the text to write in place of `lost` texts; called in the writing thread.
  using Gap = std::function<std::string(std::uint64_t lost)>;

  static constexpr std::chrono::milliseconds kFarewell{500};

  /// Writes to a duplicate of `fd`, which stays the caller's.
  AsyncWriter(int fd, std::size_t bytes_max, Gap gap = {});
  /// Allows kFarewell for writing the queue, and detaches a blocked thread.
  ~AsyncWriter();
  AsyncWriter(const AsyncWriter&) = delete;
  AsyncWriter& operator=(const AsyncWriter&) = delete;

  void offer(std::string text);
  /// Drops the queue, and the remainder of the present text if the descriptor is non-blocking.
  void clear();
  /// Waits until everything is written; false: not within `timeout`.
  bool drain(std::chrono::milliseconds timeout);
  /// Texts that were dropped or could not be written.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  struct State;
  std::shared_ptr<State> state_;  // with the thread
  std::thread thread_;
};

/// Writes before the program continues or ends; false: not completely written within AsyncWriter::kFarewell.
bool put(int fd, std::string_view text);

/// From now on output of CHECK and of the runtime to `stderr` waits 0.2 s at most, so that the program can
/// end.
void bound_standard_error();

/// A program may be started without standard streams (`<&-`). This opens /dev/null in their place, so that no
/// socket or file gets one of their descriptors and is read as keys or written as text. It runs automatically
/// at the start of a program that links this file, before shared libraries open descriptors.
void fill_standard_streams();

}  // namespace longreach
