// On a pseudo terminal: the keyboard and the view change it and give it back, however the program ends.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "master/console/terminal_view.hpp"
#include "master/input/keyboard.hpp"

namespace longreach::terminal_test {
namespace {

constexpr double kPoll_s = 0.02;

struct Pty {
  int outer = -1;  // what the person sees and types
  int inner = -1;  // the program's side
  Pty() {
    winsize size{24, 80, 0, 0};
    EXPECT_EQ(openpty(&outer, &inner, nullptr, nullptr, &size), 0);
  }
  ~Pty() {
    ::close(outer);
    ::close(inner);
  }
  [[nodiscard]] termios mode() const {
    termios present{};
    EXPECT_EQ(::tcgetattr(inner, &present), 0);
    return present;
  }
  // The system passes on what was written a little later.
  [[nodiscard]] std::string seen() const {
    std::string text;
    pollfd wait{outer, POLLIN, 0};
    while (::poll(&wait, 1, text.empty() ? 500 : 20) > 0) {
      std::array<char, 65536> bytes{};
      const ssize_t n = ::read(outer, bytes.data(), bytes.size());
      if (n <= 0) break;
      text.append(bytes.data(), static_cast<std::size_t>(n));
    }
    return text;
  }
};

bool same(const termios& a, const termios& b) {
  return a.c_lflag == b.c_lflag && a.c_iflag == b.c_iflag && a.c_oflag == b.c_oflag &&
         a.c_cc[VSUSP] == b.c_cc[VSUSP];
}

// Runs `end` in a child that has the terminal in raw mode and on the other screen; the status of its end.
template <class End>
int run_child(const Pty& pty, End end) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("TERM", "xterm", 1);
    for (const int signal : {SIGTERM, SIGABRT, SIGSEGV}) std::signal(signal, SIG_DFL);
    ::close(STDERR_FILENO);
    Keyboard keyboard({}, pty.inner);
    TerminalView view(ViewKind::kAuto, pty.inner);
    end();
    ::_exit(99);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

void fail() { throw std::runtime_error("planted"); }

TEST(Keyboard, ReadsKeysAtOnceAndWithoutEcho) {
  const Pty pty;
  Keyboard keyboard({}, pty.inner);
  EXPECT_EQ(keyboard.poll(MotionMode::kRate, kPoll_s).target_m, Vector3::Zero());  // and does not wait
  ASSERT_EQ(::write(pty.outer, "w\x1b[", 3), 3);
  EXPECT_DOUBLE_EQ(keyboard.poll(MotionMode::kRate, kPoll_s).target_m.x(), 0.001);
  ASSERT_EQ(::write(pty.outer, "Axq", 3), 3);
  const KeyboardState state = keyboard.poll(MotionMode::kRate, kPoll_s);
  EXPECT_DOUBLE_EQ(state.target_m.x(), 0.002);
  EXPECT_TRUE(state.requests.stop);
  EXPECT_TRUE(state.quit);
  EXPECT_FALSE(keyboard.poll(MotionMode::kRate, kPoll_s).requests.stop);  // once a press
  EXPECT_EQ(pty.mode().c_lflag & (ICANON | ECHO), 0u);
}

/// The last of so many polls, 50 a second, at which `keys` are typed at every `every`-th.
KeyboardState polled(Keyboard& keyboard, const Pty& pty, MotionMode mode, int polls,
                     std::string_view keys = "", int every = 50) {
  KeyboardState state;
  for (int i = 1; i <= polls; ++i) {
    if (!keys.empty() && i % every == 0) {
      EXPECT_EQ(::write(pty.outer, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
    }
    state = keyboard.poll(mode, kPoll_s);
  }
  return state;
}

TEST(Keyboard, ABurstAndKeysOfAnotherHandHaveNoEffectAndAreAnswered) {
  const Pty pty;
  Keyboard keyboard({}, pty.inner);
  const std::string burst(60, 'w');
  ASSERT_EQ(::write(pty.outer, burst.data(), burst.size()), 60);
  EXPECT_NEAR(keyboard.poll(MotionMode::kPosition, kPoll_s).target_m.x(), 0.005, 1e-12);
  EXPECT_EQ(keyboard.notice(), "55 keys had no effect, because they arrived faster than a keyboard repeats");
  ASSERT_EQ(::write(pty.outer, "w", 1), 1);
  EXPECT_NEAR(keyboard.poll(MotionMode::kPosition, kPoll_s, true).target_m.x(), 0.005, 1e-12);
  EXPECT_EQ(keyboard.notice(),
            "1 key had no effect, because another client has the handle; x stops the robot");
  keyboard.begin_at({0.02, 0.0, 0.0}, Vector3::Zero());
  ASSERT_EQ(::write(pty.outer, "w", 1), 1);
  EXPECT_NEAR(keyboard.poll(MotionMode::kPosition, kPoll_s).target_m.x(), 0.021, 1e-12);
  ASSERT_EQ(::write(pty.outer, "wwx", 3), 3);
  const KeyboardState late = keyboard.poll(MotionMode::kPosition, 0.5);
  EXPECT_NEAR(late.target_m.x(), 0.021, 1e-12);
  EXPECT_TRUE(late.requests.stop);
  EXPECT_EQ(keyboard.notice(), "2 keys had no effect, because the program had stalled when they were typed");
}

TEST(Keyboard, GoesHomeInRateModeTwoSecondsAfterTheLastKey) {
  const Pty pty;
  Keyboard keyboard({}, pty.inner);
  ASSERT_EQ(::write(pty.outer, "WW", 2), 2);
  EXPECT_DOUBLE_EQ(polled(keyboard, pty, MotionMode::kRate, 99).target_m.x(), 0.01);
  EXPECT_EQ(keyboard.notice(), "");
  EXPECT_EQ(keyboard.poll(MotionMode::kRate, kPoll_s).target_m, Vector3::Zero());
  EXPECT_NE(keyboard.notice().find("the hand returned to its home position"), std::string_view::npos);
  EXPECT_DOUBLE_EQ(polled(keyboard, pty, MotionMode::kRate, 1, "W", 1).target_m.x(), 0.005);
  EXPECT_EQ(keyboard.notice(), "");
}

TEST(Keyboard, StaysWhereItIsWhileAnyKeyComesAndInPositionMode) {
  const Pty pty;
  Keyboard keyboard({}, pty.inner);
  ASSERT_EQ(::write(pty.outer, "WW", 2), 2);
  EXPECT_DOUBLE_EQ(polled(keyboard, pty, MotionMode::kRate, 1000, "\n").target_m.x(), 0.01);
  EXPECT_DOUBLE_EQ(polled(keyboard, pty, MotionMode::kPosition, 1000).target_m.x(), 0.01);
  EXPECT_EQ(keyboard.notice(), "");
}

TEST(Keyboard, ReportsTextWithoutEndWhichKeepsNoHandOut) {
  const Pty pty;
  Keyboard keyboard({}, pty.inner);
  ASSERT_EQ(::write(pty.outer, "WW\x1b[200~hello", 13), 13);
  EXPECT_EQ(polled(keyboard, pty, MotionMode::kRate, 160, "we", 10).target_m, Vector3::Zero());
  EXPECT_NE(keyboard.notice().find("only the x key (stop) works; press Esc"), std::string_view::npos);
  EXPECT_TRUE(polled(keyboard, pty, MotionMode::kRate, 1, "x", 1).requests.stop);
}

TEST(Keyboard, GivesTheTerminalBack) {
  const Pty pty;
  const termios before = pty.mode();
  {
    const Keyboard keyboard({}, pty.inner);
    EXPECT_FALSE(same(pty.mode(), before));
  }
  EXPECT_TRUE(same(pty.mode(), before));
}

TEST(Keyboard, ReadsAPipeToItsEnd) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  Keyboard keyboard({}, ends[0]);
  ASSERT_EQ(::write(ends[1], "e", 1), 1);
  ::close(ends[1]);
  EXPECT_TRUE(keyboard.poll(MotionMode::kRate, kPoll_s).requests.engage);
  EXPECT_FALSE(keyboard.poll(MotionMode::kRate, kPoll_s).requests.engage);
  EXPECT_NE(keyboard.trouble().find("the keyboard input ended (end of input)"), std::string::npos);
  ::close(ends[0]);
}

/// Polls until it has ended; what it says of that.
std::string end_of(Keyboard& keyboard, KeyboardState& state) {
  for (int i = 0; i < 500 && keyboard.trouble().empty(); ++i) {
    state = keyboard.poll(MotionMode::kRate, kPoll_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return keyboard.trouble();
}

TEST(Keyboard, IsAHandThatLetsGoWhenItsInputEnds) {
  const Pty pty;
  const int closed = ::dup(pty.inner);
  ASSERT_EQ(::write(pty.outer, "Wc", 2), 2);
  Keyboard keyboard({}, closed);
  KeyboardState state = keyboard.poll(MotionMode::kRate, kPoll_s);
  EXPECT_GT(state.target_m.x(), 0.0);
  EXPECT_TRUE(state.requests.clutch);
  EXPECT_EQ(keyboard.trouble(), "");
  ::close(closed);  // a read error
  EXPECT_NE(end_of(keyboard, state).find("the keyboard input ended (Bad file descriptor)"),
            std::string::npos);
  EXPECT_EQ(state.target_m, Vector3::Zero());
  EXPECT_FALSE(state.requests.clutch);
}

TEST(Keyboard, SaysThatItsTerminalWasClosed) {
  Pty pty;
  ASSERT_EQ(::write(pty.outer, "W", 1), 1);
  Keyboard keyboard({}, pty.inner);
  KeyboardState state = keyboard.poll(MotionMode::kRate, kPoll_s);
  EXPECT_GT(state.target_m.x(), 0.0);
  ::close(std::exchange(pty.outer, -1));
  EXPECT_NE(end_of(keyboard, state).find("the keyboard input ended (its terminal was closed)"),
            std::string::npos);
  EXPECT_EQ(state.target_m, Vector3::Zero());
}

TEST(Keyboard, IsNotThereWithoutInputAtTheStart) {
  for (const char* path : {"/dev/null", "/"}) {
    const int fd = ::open(path, O_RDONLY);
    Keyboard keyboard({}, fd);
    KeyboardState state;
    EXPECT_EQ(end_of(keyboard, state).find("no keyboard is available ("), 0u) << path << keyboard.trouble();
    ::close(fd);
  }
}

/// In a session of its own whose terminal belongs first to another program, then to this one. 0: all is well.
int keyboard_in_background(const Pty& pty) {
  ::setsid();
  ::ioctl(pty.inner, TIOCSCTTY, 0);
  Keyboard keyboard({}, pty.inner);
  (void)!::write(pty.outer, "W", 1);
  if (keyboard.poll(MotionMode::kRate, kPoll_s).target_m.x() <= 0.0) return 1;
  const pid_t other = ::fork();
  if (other == 0) {
    ::setpgid(0, 0);
    ::pause();
  }
  ::setpgid(other, other);
  ::tcsetpgrp(pty.inner, other);
  if (keyboard.poll(MotionMode::kRate, kPoll_s).target_m.x() != 0.0) return 2;
  if (keyboard.trouble().find("is in the background") == std::string::npos) return 3;
  termios shell = pty.mode();
  shell.c_lflag |= ICANON;
  std::signal(SIGTTOU, SIG_IGN);
  ::tcsetattr(pty.inner, TCSANOW, &shell);
  ::tcsetpgrp(pty.inner, ::getpgrp());
  ::kill(other, SIGKILL);
  (void)keyboard.poll(MotionMode::kRate, kPoll_s);
  (void)!::write(pty.outer, "W", 1);
  return keyboard.poll(MotionMode::kRate, kPoll_s).target_m.x() > 0.0 && keyboard.trouble().empty() ? 0 : 4;
}

TEST(Keyboard, LetsGoInTheBackgroundAndIsReadAgainInTheForeground) {
  const Pty pty;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(keyboard_in_background(pty));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0) << status;
}

TEST(TerminalGuard, GivesTheTerminalBackWhenASignalEndsTheProgram) {
  for (const int signal : {SIGTERM, SIGABRT, SIGSEGV}) {
    const Pty pty;
    const termios before = pty.mode();
    const int status = run_child(pty, [signal] { std::raise(signal); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_TRUE(same(pty.mode(), before)) << signal;
    EXPECT_NE(pty.seen().find("\x1b[?1049l"), std::string::npos) << signal;
  }
}

TEST(TerminalGuard, GivesTheTerminalBackOnExitAndOnAnUncaughtException) {
  const Pty pty;
  const termios before = pty.mode();
  EXPECT_EQ(WEXITSTATUS(run_child(pty, [] { std::exit(3); })), 3);
  EXPECT_TRUE(same(pty.mode(), before));
  EXPECT_TRUE(WIFSIGNALED(run_child(pty, []() noexcept { fail(); })));
  EXPECT_TRUE(same(pty.mode(), before));
}

TEST(TerminalView, RedrawsInPlaceAndNotMoreOftenThanTenTimesASecond) {
  ::setenv("TERM", "xterm", 1);
  const Pty pty;
  TerminalView view(ViewKind::kAuto, pty.inner);
  ASSERT_TRUE(view.live());
  EXPECT_NE(pty.seen().find("\x1b[?1049h"), std::string::npos);
  int drawn = 0;
  ConsoleSnapshot snapshot;
  std::string frame;
  for (int tick = 0; tick < 1000; ++tick) {  // one second in milliseconds
    snapshot.seconds = 1e-3 * tick;
    view.show(snapshot);
    if (tick % 100 != 0) continue;
    frame = pty.seen();
    drawn += frame.starts_with("\x1b[H") ? 1 : 0;
    EXPECT_EQ(frame.find("\x1b[2J"), std::string::npos);  // blanking first would flicker
    // After a line of full width, the cursor is on its last character, which clearing would erase.
    for (std::size_t at = frame.find("\x1b[K"); at != std::string::npos; at = frame.find("\x1b[K", at + 1)) {
      EXPECT_TRUE(at > 0 && (frame[at - 1] == '\n' || frame[at - 1] == 'H')) << frame;
    }
  }
  EXPECT_EQ(drawn, 10);
  EXPECT_LT(std::count(frame.begin(), frame.end(), '\n'), 24);
}

/// Frames until the terminal takes no more, and then as many again.
void draw_unread(TerminalView& view) {
  ConsoleSnapshot snapshot;
  for (int i = 1; i <= 400; ++i) {
    snapshot.seconds = 0.1 * i;
    view.show(snapshot);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(TerminalView, UnreadTerminalDelaysNothingAndIsRestored) {
  ::setenv("TERM", "xterm", 1);
  const Pty pty;
  const int flags = ::fcntl(pty.inner, F_GETFL);
  {
    TerminalView view(ViewKind::kAuto, pty.inner);
    draw_unread(view);
    pollfd room{pty.inner, POLLOUT, 0};
    EXPECT_EQ(::poll(&room, 1, 0), 0);  // it is full: a write would wait
    EXPECT_EQ(::fcntl(pty.inner, F_GETFL), flags);
  }
  EXPECT_NE(pty.seen().find("\x1b[?1049l"), std::string::npos);
  EXPECT_EQ(::fcntl(pty.inner, F_GETFL), flags);
}

TEST(TerminalGuard, ASignalEndsAProgramWhoseTerminalNobodyReads) {
  const Pty pty;
  const termios before = pty.mode();
  const int status = run_child(pty, [&pty] {
    TerminalView view(ViewKind::kAuto, pty.inner);
    draw_unread(view);
    std::raise(SIGTERM);
  });
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
  EXPECT_TRUE(same(pty.mode(), before));
}

TEST(TerminalView, WritesEventsOnceAndFiguresEveryFiveSecondsIntoAPipe) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  TerminalView view(ViewKind::kAuto, ends[1]);
  EXPECT_FALSE(view.live());
  ConsoleSnapshot snapshot;
  for (int tick = 0; tick < 12000; ++tick) {
    snapshot.seconds = 1e-3 * tick;
    snapshot.view.state = tick < 7000 ? SafetyState::kIdle : SafetyState::kEngaged;
    view.show(snapshot);
  }
  view.close();
  ::close(ends[1]);
  std::array<char, 65536> bytes{};
  const ssize_t n = ::read(ends[0], bytes.data(), bytes.size());
  const std::string text(bytes.data(), static_cast<std::size_t>(n));
  std::istringstream lines(text);
  int events = 0, figures = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 120U) << line;
    figures += line.find("  rtt ") != std::string::npos;
    events += line.find("s  Idle: ") != std::string::npos || line.find("s  Engaged: ") != std::string::npos;
  }
  EXPECT_EQ(figures, 3) << text;
  EXPECT_EQ(events, 2) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  ::close(ends[0]);
}

}  // namespace
}  // namespace longreach::terminal_test
