#include "master/console/keyboard.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "master/console/terminal_guard.hpp"

namespace longreach {
namespace {

constexpr int kReadsMax = 16;  // a poll, so that a flood of input cannot keep it

bool readable(int fd) {
  pollfd waiting{fd, POLLIN, 0};
  return ::poll(&waiting, 1, 0) > 0 && (waiting.revents & (POLLIN | POLLHUP)) != 0;
}

}  // namespace

Keyboard::Keyboard(const KeyboardConfig& config, int fd) : config_(config), fd_(fd) {
  termios mode{};
  if (::isatty(fd_) != 1 || ::tcgetattr(fd_, &mode) != 0) return;
  keep_terminal_mode(fd_, mode);
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_iflag &= ~static_cast<tcflag_t>(IXON);  // ctrl-S must not stop the view
  mode.c_cc[VSUSP] = _POSIX_VDISABLE;            // nor ctrl-Z a program that steers a robot
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  raw_ = ::tcsetattr(fd_, TCSANOW, &mode) == 0;
}

Keyboard::~Keyboard() {
  if (raw_) give_back_terminal_mode();
}

KeyboardState Keyboard::poll(MotionMode mode) {
  const bool clutch = state_.requests.clutch;
  state_.requests = {};
  state_.requests.clutch = clutch;
  std::array<char, 256> bytes{};
  for (int i = 0; i < kReadsMax && !ended_ && readable(fd_); ++i) {
    const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      ended_ = true;
      break;
    }
    for (const Key& key : parser_.feed({bytes.data(), static_cast<std::size_t>(n)})) {
      apply(key, config_, mode, state_);
    }
  }
  return state_;
}

}  // namespace longreach
