#pragma once
// Shows the progress and the remaining time of a long command: on a terminal, it rewrites a single line in
// place; elsewhere, it prints a plain line every ten seconds, so that short commands print nothing.

#include <chrono>
#include <ostream>
#include <string>

namespace longreach {

class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style { kNone, kPlain, kTerminal };

  static constexpr std::chrono::seconds kPlainEvery{10};

  /// Writes to standard error. The style depends on whether standard error is a terminal.
  explicit ProgressLine(bool quiet);
  ProgressLine(std::ostream& out, Style style, Clock::time_point began);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows `what`, e.g. "sweep: 3 of 10 cells", and the remaining time, estimated from the completed fraction
  /// `done`.
  void show(const std::string& what, double done, Clock::time_point now = Clock::now());
  /// Clears the line on the terminal.
  void clear();

 private:
  std::ostream& out_;
  Style style_;
  Clock::time_point began_, said_;
};

}  // namespace longreach
