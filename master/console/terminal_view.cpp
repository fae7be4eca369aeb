#include "master/console/terminal_view.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "master/input/terminal_guard.hpp"

namespace longreach {
namespace {

constexpr double kLivePeriodS = 0.1;
constexpr double kPlainPeriodS = 0.1, kFiguresPeriodS = 5.0;
constexpr std::size_t kPlainMaxBytes = 64 << 10;
constexpr std::chrono::milliseconds kScreenTimeout{200};
constexpr std::string_view kEnter =
    "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[2J"  // alternate screen, no cursor, no wrap, clear
    "\x1b[?2004h"                          // bracketed paste, so that pasted text is not read as keys
    "\x1b[?1007s\x1b[?1007l";              // on this screen, the mouse wheel must not send arrow keys

struct ScreenSize {
  int columns = 80;
  int rows = 24;
};

ScreenSize size_of(int fd) {
  winsize size{};
  if (::ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

bool can_redraw(int fd) {
  const char* term = std::getenv("TERM");
  return ::isatty(fd) == 1 && term != nullptr && std::string_view(term) != "dumb" && *term != '\0';
}

// Starts at the top left corner. Each line is cleared before it is written, and the last one with the screen below: after a
// line of full width, the cursor is still on its last character. The screen is not blanked first, so it does not flicker.
// Rows that do not fit are omitted, because the screen would scroll.
std::string in_place(std::string_view page, int rows) {
  std::string text = "\x1b[H";
  for (int row = 0; row < rows && !page.empty(); ++row) {
    const std::size_t end = std::min(page.find('\n'), page.size());
    if (row > 0) text += "\r\n";
    const std::string_view line = page.substr(0, end);
    page.remove_prefix(std::min(end + 1, page.size()));
    text.append(page.empty() || row + 1 == rows ? "\x1b[J" : "\x1b[K").append(line);
  }
  return text;
}

/// Removes the digits, because measured values change all the time.
std::string without_figures(std::string text) {
  std::erase_if(text,
                [](unsigned char c) { return std::isdigit(c) != 0 || c == '.' || c == ' ' || c == '-'; });
  constexpr std::string_view kAge = "(sago)";
  if (const std::size_t at = text.find(kAge); at != std::string::npos) text.erase(at, kAge.size());
  return text;
}

}  // namespace

TerminalView::TerminalView(ViewKind kind, int fd)
    : fd_(fd), live_(kind == ViewKind::kAuto && can_redraw(fd)), plain_(kind != ViewKind::kNone && !live_) {
  const char* no_color = std::getenv("NO_COLOR");  // no-color.org
  color_ = live_ && (no_color == nullptr || *no_color == '\0');
  if (plain_) async_writer_.emplace(fd_, kPlainMaxBytes);
  if (!live_) return;
  // A thread that blocks in a write would keep all other code from the terminal, including the code that
  // restores it.
  const int own = open_anew(fd_);
  async_writer_.emplace(own, 0);
  ::close(own);
  keep_screen(fd_);
  async_writer_->offer(std::string(kEnter));
  async_writer_->drain(kScreenTimeout);  // before a signal handler may restore the screen
}

TerminalView::~TerminalView() { close(); }

void TerminalView::close() {
  if (live_) {
    async_writer_->clear();
    async_writer_->drain(kScreenTimeout);
    give_back_screen();
  }
  live_ = plain_ = false;
  async_writer_.reset();
}

void TerminalView::show(const ConsoleSnapshot& snapshot) {
  if ((!live_ && !plain_) || snapshot.seconds < next_s_) return;
  const double period_s = live_ ? kLivePeriodS : kPlainPeriodS;
  next_s_ = (std::floor(snapshot.seconds / period_s + 1e-6) + 1.0) * period_s - 1e-6;
  if (plain_) {
    std::string text, event = without_figures(render_event(snapshot));
    if (event != event_) text = render_event(snapshot) + "\n";
    if (snapshot.seconds >= next_figures_s_) {
      text += render_line(snapshot) + "\n";
      next_figures_s_ =
          (std::floor(snapshot.seconds / kFiguresPeriodS + 1e-6) + 1.0) * kFiguresPeriodS - 1e-6;
    }
    event_ = std::move(event);
    if (!text.empty()) async_writer_->offer(std::move(text));
    return;
  }
  const ScreenSize size = size_of(fd_);
  async_writer_->offer(in_place(render(snapshot, size.columns, color_, size.rows), size.rows));
}

}  // namespace longreach
