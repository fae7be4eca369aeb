#include "master/console/terminal_guard.hpp"

#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>

namespace longreach {
namespace {

constexpr std::array<char, 19> kLeaveScreen = {'\x1b', '[',    '?', '7', 'h', '\x1b', '[', '?', '2', '5',
                                               'h',    '\x1b', '[', '?', '1', '0',    '4', '9', 'l'};

std::atomic<int> mode_fd{-1};
std::atomic<int> screen_fd{-1};
termios kept_mode{};  // written before mode_fd says that it is there

// Only what POSIX allows inside of a signal.
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
  static const int at_exit = std::atexit(give_back_all);  // once
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

void keep_terminal_mode(int fd, const termios& mode) {
  kept_mode = mode;
  mode_fd = fd;
  watch();
}

void give_back_terminal_mode() {
  const int fd = mode_fd.exchange(-1);
  if (fd >= 0) ::tcsetattr(fd, TCSANOW, &kept_mode);
}

void keep_screen(int fd) {
  screen_fd = fd;
  watch();
}

void give_back_screen() {
  const int fd = screen_fd.exchange(-1);
  if (fd < 0) return;
  // Nothing can be done about a terminal that is gone.
  [[maybe_unused]] const ssize_t written = ::write(fd, kLeaveScreen.data(), kLeaveScreen.size());
}

}  // namespace longreach
