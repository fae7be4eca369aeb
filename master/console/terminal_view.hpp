#pragma once
// A live view of the master in the terminal. render() returns the picture as text, a pure function.
// TerminalView draws it on the screen: redrawn in place, at most ten times a second, in one write so that it
// does not flicker. Where that is not possible it prints plain lines: the state when it changes, figures
// every five seconds. A stalled terminal or pipe delays nothing: complete pictures are skipped if there is no
// room for them.

#include <optional>
#include <string>

#include "common/program/async_writer.hpp"
#include "master/console/snapshot.hpp"

namespace longreach {

/// Returns the whole picture, lines ended by '\n', none longer than max(width, 60) columns; with ANSI colours
/// on request.
std::string render(const ConsoleSnapshot& snapshot, int width, bool color);

/// Returns the figures in one line of at most 120 columns without a newline, for logs and pipes.
std::string render_line(const ConsoleSnapshot& snapshot);
/// Returns the present state in the same format; long sentences continue in the following lines.
std::string render_event(const ConsoleSnapshot& snapshot);

enum class ViewKind { kAuto, kPlain, kNone };  // kAuto: live on a terminal, otherwise plain

class TerminalView {
 public:
  /// Draws on the file descriptor `fd`, 1: standard output.
  explicit TerminalView(ViewKind kind, int fd = 1);
  /// Restores the screen.
  ~TerminalView();
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  /// May be called at any rate: pictures that come too early by `snapshot.seconds` are skipped.
  void show(const ConsoleSnapshot& snapshot);
  /// Restores the screen, also if the terminal is stalled; later calls of show() draw nothing. Call it before
  /// the summary.
  void close();

  [[nodiscard]] bool live() const { return live_; }

 private:
  int fd_;
  bool live_ = false;
  bool plain_ = false;
  bool color_ = false;
  double next_s_ = 0.0, next_figures_s_ = 0.0;
  std::string event_{};  // the last event, without its figures
  std::optional<AsyncWriter> async_writer_;
};

}  // namespace longreach
