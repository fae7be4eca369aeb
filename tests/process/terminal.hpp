#pragma once
// A pseudoterminal for tests of programs that read keys from a terminal, and a key that is held down.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace longreach {

/// A pseudoterminal. `outer` is the user's end, and `inner` is the program's end.
struct Terminal {
  int outer = -1, inner = -1;
  Terminal() {
    winsize size{24, 80, 0, 0};
    EXPECT_EQ(::openpty(&outer, &inner, nullptr, nullptr, &size), 0);
    // A program that another test starts at the same time would keep the terminal open.
    for (const int end : {outer, inner}) EXPECT_EQ(::fcntl(end, F_SETFD, FD_CLOEXEC), 0);
    ::setenv("TERM", "xterm", 1);
  }
  ~Terminal() {
    ::close(outer);
    ::close(inner);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  /// Writes all at once.
  void paste(const std::string& text) const {
    EXPECT_EQ(::write(outer, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// Types at the pace of a key that repeats 30 times a second: faster ones have no effect.
  void type(const std::string& keys) const {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i > 0) std::this_thread::sleep_for(std::chrono::milliseconds(33));
      paste(keys.substr(i, 1));
    }
  }
  /// Returns whether a write by the program would block.
  [[nodiscard]] bool full() const {
    pollfd room{inner, POLLOUT, 0};
    return ::poll(&room, 1, 0) == 0;
  }
};

/// Holds down a key that has no function, so that the hand stays in place in rate mode.
class HeldKey {
 public:
  explicit HeldKey(int fd) : fd_(fd) {}
  ~HeldKey() {
    released_ = true;
    thread_.join();
  }
  HeldKey(const HeldKey&) = delete;
  HeldKey& operator=(const HeldKey&) = delete;

 private:
  void repeat() {
    while (!released_) {
      (void)!::write(fd_, "\n", 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

  int fd_;
  std::atomic<bool> released_{false};
  std::thread thread_{[this] { repeat(); }};
};

}  // namespace longreach
