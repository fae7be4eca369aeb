#include "master/input/keyboard.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "master/input/terminal_guard.hpp"

namespace longreach {
namespace {

constexpr int kRatePolls = 100;  // 2 s
constexpr int kReadsMax = 16;    // per poll, so that a flood of input cannot block it

/// Returns whether there is input, end of file or an error, which read() distinguishes.
bool readable(int fd) {
  pollfd waiting{fd, POLLIN, 0};
  return ::poll(&waiting, 1, 0) > 0;
}

}  // namespace

Keyboard::Keyboard(const KeyboardConfig& config, int fd) : config_(config), fd_(fd) {
  if (!in_background(fd_)) set_raw();
}

Keyboard::~Keyboard() {
  if (raw_) give_back_terminal_mode();
}

// Called again each time the program returns from the background, because the shell sets its own mode.
void Keyboard::set_raw() {
  termios mode{};
  if (::tcgetattr(fd_, &mode) != 0 || (raw_ && (mode.c_lflag & ICANON) == 0)) return;
  keep_terminal_mode(fd_, mode);
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_iflag &= ~static_cast<tcflag_t>(IXON);  // Ctrl-S must not stop the view
  mode.c_cc[VSUSP] = _POSIX_VDISABLE;            // nor Ctrl-Z a program that controls a robot
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  raw_ = ::tcsetattr(fd_, TCSANOW, &mode) == 0;
}

KeyboardState Keyboard::poll(MotionMode mode, double since_s, bool elsewhere) {
  const bool clutch = state_.requests.clutch;
  state_.requests = {};
  state_.requests.clutch = clutch;
  if (ended_) return state_;
  trouble_.clear();
  allowance_.poll(since_s, elsewhere);
  if (in_background(fd_)) {
    trouble_ = "longreach-master is in the background; bring it to the foreground (fg), then engage";
  } else {
    set_raw();
    read_all(mode);
  }
  // A terminal does not report the release of a key, and in rate mode a deflection would move the robot
  // indefinitely.
  if (++idle_polls_ >= kRatePolls && mode == MotionMode::kRate &&
      !(state_.target_m.isZero(0.0) && state_.target_rad.isZero(0.0))) {
    go_home();
    let_go_ = true;
  }
  if (trouble_.empty()) return state_;
  go_home();
  state_.requests.clutch = false;
  return state_;
}

void Keyboard::go_home() {
  state_.target_m.setZero();
  state_.target_rad.setZero();
}

void Keyboard::read_all(MotionMode mode) {
  std::array<char, 256> bytes{};
  parser_.tick();
  for (int i = 0; i < kReadsMax && readable(fd_); ++i) {
    const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n == 0) return end(raw_ ? "its terminal was closed" : "end of input");
    if (n < 0) return end(std::strerror(errno));
    used_ = true;
    if (!parser_.overdue()) {
      idle_polls_ = 0;
      let_go_ = false;
    }
    for (const Key& key : parser_.feed({bytes.data(), static_cast<std::size_t>(n)})) {
      if (allowance_.takes(key)) apply(key, config_, mode, state_);
    }
  }
}

std::string Keyboard::notice() const {
  if (!trouble_.empty()) return "";
  if (parser_.overdue())
    return "a paste or control sequence from the keyboard is incomplete: only the x key (stop) works; "
           "press Esc";
  if (let_go_)
    return "no key for 2 s in rate mode: the hand returned to its home position; hold Enter to keep "
           "it in place";
  if (allowance_.dropped() == 0) return "";
  const bool one = allowance_.dropped() == 1;
  const std::string keys = one ? "1 key" : std::to_string(allowance_.dropped()) + " keys";
  switch (allowance_.why()) {
    case KeyAllowance::Why::kElsewhere:
      return keys + " had no effect, because another client has the handle; x stops the robot";
    case KeyAllowance::Why::kLate:
      return keys + " had no effect, because the program had stalled when " + (one ? "it was" : "they were") +
             " typed";
    default:
      return keys + " had no effect, because " + (one ? "it" : "they") +
             " arrived faster than a keyboard repeats";
  }
}

void Keyboard::end(const std::string& why) {
  ended_ = true;
  trouble_ = (used_ ? "the keyboard input ended" : "no keyboard is available") + (" (" + why) +
             "); start longreach-master in a terminal, or use another operator";
}

}  // namespace longreach
