// longreach watch: a table that is redrawn in place on a terminal, or one line per update elsewhere.

#include <pthread.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string_view>

#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/paint.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kSettleCheck = std::chrono::milliseconds(20);
constexpr auto kTableAfter = std::chrono::seconds(3);

/// Blocks SIGINT and SIGTERM, so that they can be waited for.
class EndRequest {
 public:
  /// Create it before the first thread, because threads inherit the blocked signals.
  EndRequest() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }
  /// Returns true as soon as such a signal arrives, or false at `due`.
  [[nodiscard]] bool wait_until(Clock::time_point due) const {
    const auto left = std::max(due - Clock::now(), Clock::duration::zero());
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    const timespec timeout{static_cast<time_t>(seconds.count()),
                           static_cast<long>(std::chrono::nanoseconds(left - seconds).count())};
    return sigtimedwait(&signals_, nullptr, &timeout) > 0;
  }

 private:
  sigset_t signals_{};
};

/// Draws a text over the previous one in a single write, without clearing the screen, so that it does not
/// flicker.
class TerminalArea {
 public:
  explicit TerminalArea(bool color) : color_(color) { std::cout << "\x1b[?25l"; }  // hides the cursor
  ~TerminalArea() { std::cout << "\x1b[?25h" << std::flush; }
  TerminalArea(const TerminalArea&) = delete;
  TerminalArea& operator=(const TerminalArea&) = delete;

  struct Size {
    std::size_t columns = 1000, rows = 1000;
  };
  [[nodiscard]] static Size size() {
    winsize size{};
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    return {size.ws_col > 0 ? size.ws_col : 1000U, size.ws_row > 1 ? size.ws_row - 1U : 1000U};
  }

  void draw(std::string_view text) {
    const auto [columns_max, rows_max] = size();
    std::string out = rows_ > 0 ? "\x1b[" + std::to_string(rows_) + "A" : "";
    rows_ = 0;
    while (!text.empty() && rows_ < rows_max) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      // Lines are cut to the width, because a wrapped line would count twice.
      const std::string_view row = text.substr(0, std::min(end, columns_max));
      out +=
          "\x1b[K" + (color_ ? painted(row) : std::string(row)) + "\n";  // K after a full line erases its end
      text.remove_prefix(std::min(end + 1, text.size()));
      ++rows_;
    }
    std::cout << out << "\x1b[J" << std::flush;
  }

 private:
  bool color_;
  std::size_t rows_ = 0;  // drawn last
};

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool can_redraw() { return isatty(STDOUT_FILENO) == 1 && environment("TERM") != "dumb"; }

std::string down_lines(const BothReports& reports) {
  std::string text;
  for (const SideReport* report : {&reports.master, &reports.slave})
    if (!report->status) text += report->error + "\n";
  return text;
}

}  // namespace

ExitStatus run_watch(const Options& options, const WatchCommand& command) {
  const EndRequest end;
  const StatusStream master(Side::kMaster, options, command.rate_hz);
  const StatusStream slave(Side::kSlave, options, command.rate_hz);
  std::optional<TerminalArea> area;
  if (!options.json && !command.plain && can_redraw()) area.emplace(environment("NO_COLOR").empty());
  // A line remains, so the first one is complete; a table is redrawn.
  const auto began = Clock::now();
  while (!(master.settled() && slave.settled()) && (!area || Clock::now() - began < kTableAfter))
    if (end.wait_until(Clock::now() + kSettleCheck)) return ExitStatus::kDone;
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / command.rate_hz));
  auto due = Clock::now();
  std::uint64_t shown = 0;
  while (!end.wait_until(due)) {
    const BothReports reports{master.newest(), slave.newest()};
    if (area) {
      const auto [columns, rows] = TerminalArea::size();
      const std::string below = folded(down_lines(reports), columns) + "Ctrl-C quits\n";
      const auto taken = static_cast<std::size_t>(std::ranges::count(below, '\n'));
      area->draw(watch_table(reports, columns, rows - std::min(rows, taken)) + below);
    } else {
      std::cout << (options.json ? status_json(reports) : status_line(reports)) << std::endl;
    }
    if (!std::cout)
      throw SideError(SideError::Kind::kRefused,
                      "the output cannot be written, because it is closed or full");
    if (++shown == command.count)
      return reports.master.status && reports.slave.status ? ExitStatus::kDone : ExitStatus::kFailed;
    due = std::max(due + period, Clock::now());
  }
  return ExitStatus::kDone;
}

}  // namespace longreach
