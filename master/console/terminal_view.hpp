#pragma once
// A live view of the master in the terminal. render() is a pure function that returns the view as text.
// TerminalView draws it on the screen: it is redrawn in place at most ten times a second, with one write per
// frame so that it does not flicker. If live drawing is not possible, it prints plain lines: the state
// whenever it changes, and the measured values every five seconds. A stalled terminal or pipe does not delay
// the caller: while the output is blocked, whole frames are skipped.

#include <optional>
#include <string>

#include "common/program/async_writer.hpp"
#include "master/console/snapshot.hpp"

namespace longreach {

/// Returns the view as at most `rows` lines terminated by '\n', each at most max(width, 60) columns wide. If lines do not
/// fit, the last line says how many. ANSI colours are included if `color` is true.
std::string render(const ConsoleSnapshot& snapshot, int width, bool color, int rows = 1000);

/// Returns the measured values in one line of at most 120 columns without a newline, for logs and pipes.
std::string render_line(const ConsoleSnapshot& snapshot);
/// Returns the current state in the same format. Long sentences continue on the following lines.
std::string render_event(const ConsoleSnapshot& snapshot);

enum class ViewKind { kAuto, kPlain, kNone };  // kAuto: live on a terminal, plain otherwise

class TerminalView {
 public:
  /// Draws on the file descriptor `fd` (1 is standard output).
  explicit TerminalView(ViewKind kind, int fd = 1);
  /// Restores the screen.
  ~TerminalView();
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  /// Draws the snapshot. It may be called at any rate: a snapshot that follows the previous one too soon,
  /// according to `snapshot.seconds`, is skipped.
  void show(const ConsoleSnapshot& snapshot);
  /// Restores the screen, even if the terminal is stalled. Later calls of show() draw nothing. Call this
  /// before printing the summary.
  void close();

  /// Returns whether the view is redrawn in place.
  [[nodiscard]] bool live() const { return live_; }

 private:
  int fd_;
  bool live_ = false;
  bool plain_ = false;
  bool color_ = false;
  double next_s_ = 0.0, next_figures_s_ = 0.0;
  std::string event_{};  // the last event without its measured values and their age
  std::optional<AsyncWriter> async_writer_;
};

}  // namespace longreach
