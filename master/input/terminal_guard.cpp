#include "master/input/terminal_guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace longreach {
namespace {

constexpr std::string_view kLeaveScreen = "\x1b[?1007r\x1b[?2004l\x1b[?7h\x1b[?25h\x1b[?1049l";

constexpr int kTries = 20;
constexpr int kTryPause_ms = 10;

std::atomic<int> mode_fd{-1};
std::atomic<int> screen_fd{-1};  // non-blocking
termios kept_mode{};             // written before mode_fd marks it as valid

// Uses only functions that POSIX allows in a signal handler.
void give_back_all() {
  give_back_screen();
  give_back_terminal_mode();
}

void on_fatal_signal(int signal) {
  give_back_all();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void watch() {
  static const int at_exit = std::atexit(give_back_all);  // registered once
  static_cast<void>(at_exit);
  for (const int signal :
       {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) continue;
    struct sigaction ours {};
    ours.sa_handler = on_fatal_signal;
    sigemptyset(&ours.sa_mask);
    ::sigaction(signal, &ours, nullptr);
  }
}

}  // namespace

bool in_background(int fd) {
  const pid_t owner = ::tcgetpgrp(fd);
  return owner >= 0 && owner != ::getpgrp();
}

void keep_terminal_mode(int fd, const termios& mode) {
  mode_fd = -1;
  kept_mode = mode;
  mode_fd = fd;
  watch();
}

void give_back_terminal_mode() {
  const int fd = mode_fd.exchange(-1);
  // Changing a terminal that belongs to another program would stop this one (SIGTTOU).
  if (fd >= 0 && !in_background(fd)) ::tcsetattr(fd, TCSANOW, &kept_mode);
}

int open_anew(int fd) {
  std::array<char, 32> path{};
  std::snprintf(path.data(), path.size(), "/proc/self/fd/%d", fd);
  const int anew = ::open(path.data(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  return anew >= 0 ? anew : ::fcntl(fd, F_DUPFD_CLOEXEC, 3);
}

void keep_screen(int fd) {
  screen_fd = open_anew(fd);
  watch();
}

void give_back_screen() {
  const int fd = screen_fd.exchange(-1);
  if (fd < 0) return;
  std::size_t written = 0;
  for (int i = 0; i < kTries && written < kLeaveScreen.size(); ++i) {
    const ssize_t n = ::write(fd, kLeaveScreen.data() + written, kLeaveScreen.size() - written);
    if (n > 0) written += static_cast<std::size_t>(n);
    if (n < 0 && errno != EAGAIN && errno != EINTR) break;  // the terminal is closed
    if (n > 0) continue;
    if (i == kTries / 2) ::tcflush(fd, TCOFLUSH);  // the output is not being read; discards it to make room
    ::poll(nullptr, 0, kTryPause_ms);
  }
  ::close(fd);
}

}  // namespace longreach
