#pragma once
// A calm live view of the master in the terminal. render() is the picture as text, a pure function;
// TerminalView puts it on the screen: redrawn in place, at most ten times a second, in one write so that it
// does not flicker; or, where that is not possible, plain lines: what is happening when it changes, figures
// every five seconds. A terminal or a pipe that takes
// nothing makes nobody wait: pictures that it has no room for are left out, whole ones.

#include <optional>
#include <string>

#include "common/program/async_writer.hpp"
#include "master/console/snapshot.hpp"

namespace longreach {

/// The whole picture, lines ended by '\n', none longer than max(width, 60) columns; with ANSI colours if
/// asked for.
std::string render(const ConsoleSnapshot& snapshot, int width, bool color);

/// The figures in one line of at most 120 columns without its end, for logs and pipes.
std::string render_line(const ConsoleSnapshot& snapshot);
/// What is happening, likewise; longer sentences go on in the lines below.
std::string render_event(const ConsoleSnapshot& snapshot);

enum class ViewKind { kAuto, kPlain, kNone };  // kAuto: live on a terminal, else plain

class TerminalView {
 public:
  /// Draws on the file descriptor `fd`, 1: standard output.
  explicit TerminalView(ViewKind kind, int fd = 1);
  /// Gives the screen back as it was.
  ~TerminalView();
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  /// Call it as often as convenient: what comes too early by `snapshot.seconds` is not drawn.
  void show(const ConsoleSnapshot& snapshot);
  /// Gives the screen back, whether or not somebody reads it; later calls of show() draw nothing. For the
  /// summary that follows.
  void close();

  [[nodiscard]] bool live() const { return live_; }

 private:
  int fd_;
  bool live_ = false;
  bool plain_ = false;
  bool color_ = false;
  double next_s_ = 0.0, next_figures_s_ = 0.0;
  std::string event_{};  // the last one, without its figures
  std::optional<AsyncWriter> async_writer_;
};

}  // namespace longreach
