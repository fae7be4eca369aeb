#pragma once

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

/// A pseudoterminal: the user's end and the program's end.
struct Terminal {
  int outer = -1, inner = -1;
  Terminal() {
    winsize size{24, 80, 0, 0};
    EXPECT_EQ(::openpty(&outer, &inner, nullptr, nullptr, &size), 0);
    ::setenv("TERM", "xterm", 1);
  }
  ~Terminal() {
    ::close(outer);
    ::close(inner);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  void type(const std::string& keys) const {
    EXPECT_EQ(::write(outer, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// Returns whether a write of the program would block.
  [[nodiscard]] bool full() const {
    pollfd room{inner, POLLOUT, 0};
    return ::poll(&room, 1, 0) == 0;
  }
};

/// Holds down a key without a function, so that in rate mode the hand stays in place.
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
