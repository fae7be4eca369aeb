#pragma once
// Writes text to a terminal, pipe or file, even if its reader stalls: a separate thread writes, so the caller
// never waits. At most `bytes_max` bytes are queued. If the queue is full, the oldest texts are dropped and
// counted; the newest text is always kept. A text is written completely or not at all.

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
  /// Returns the text to write in place of `lost` dropped texts. Called in the writing thread.
  using Gap = std::function<std::string(std::uint64_t lost)>;

  static constexpr std::chrono::milliseconds kFarewell{500};

  /// Writes to a duplicate of `fd`; the caller keeps `fd` itself.
  AsyncWriter(int fd, std::size_t bytes_max, Gap gap = {});
  /// Waits up to kFarewell for the queue to be written, then detaches the thread if it is blocked.
  ~AsyncWriter();
  AsyncWriter(const AsyncWriter&) = delete;
  AsyncWriter& operator=(const AsyncWriter&) = delete;

  void offer(std::string text);
  /// Drops the queue. If the descriptor is non-blocking, also drops the remainder of the text that is being
  /// written.
  void clear();
  /// Waits until everything is written. Returns false if this takes longer than `timeout`.
  bool drain(std::chrono::milliseconds timeout);
  /// Returns the number of texts that were dropped or could not be written.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  struct State;
  std::shared_ptr<State> state_;  // shared with the thread
  std::thread thread_;
};

/// Writes text synchronously. Returns false if this could not be completed within
/// AsyncWriter::kFarewell.
bool put(int fd, std::string_view text);

/// After this call, output of CHECK and of the runtime library to `stderr` blocks for at most 0.2 s, so that
/// the program can end.
void bound_standard_error();

}  // namespace longreach
