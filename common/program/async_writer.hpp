#pragma once
// Text on its way to a terminal, a pipe or a file whose other end may stop taking it. A thread of its own
// writes; who offers never waits. At most `bytes_max` wait, the newest text always; the oldest is dropped and
// counted. Whole texts only: what has been begun is written to its end.

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
  /// What to write where `lost` texts are missing, in the writing thread.
  using Gap = std::function<std::string(std::uint64_t lost)>;

  static constexpr std::chrono::milliseconds kFarewell{500};

  /// Writes to a duplicate of `fd`, which stays the caller's.
  AsyncWriter(int fd, std::size_t bytes_max, Gap gap = {});
  /// Gives what waits kFarewell to be written, and leaves a thread that is stuck to itself.
  ~AsyncWriter();
  AsyncWriter(const AsyncWriter&) = delete;
  AsyncWriter& operator=(const AsyncWriter&) = delete;

  void offer(std::string text);
  /// Drops what waits, and the rest of what is being written where the descriptor never waits.
  void clear();
  /// Waits until nothing waits or is being written; false: not within `timeout`.
  bool drain(std::chrono::milliseconds timeout);
  /// Texts that were dropped or could not be written.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  struct State;
  std::shared_ptr<State> state_;  // with the thread
  std::thread thread_;
};

/// Writes before the program goes on or ends; false: not all of it was taken within AsyncWriter::kFarewell.
bool put(int fd, std::string_view text);

/// From now on what CHECK and the language's own last words print to `stderr` waits 0.2 s at most, so that a
/// program which must end does.
void bound_standard_error();

/// A program may be started without input and outputs (`<&-`): opens /dev/null in their places, lest a socket
/// or a file takes one and is read as keys or written as text. Runs by itself at the start of a program that
/// links this file, before shared libraries open descriptors.
void fill_standard_streams();

}  // namespace longreach
