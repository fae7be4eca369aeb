#include "deploy/lab/progress_line.hpp"

#include <unistd.h>

#include <cmath>
#include <iostream>

namespace longreach {
namespace {

constexpr double kForecastFrom_s = 1.0;  // before that, the fraction is too small for an estimate

ProgressLine::Style style_of_standard_error(bool quiet) {
  if (quiet) return ProgressLine::Style::kNone;
  return isatty(STDERR_FILENO) == 1 ? ProgressLine::Style::kTerminal : ProgressLine::Style::kPlain;
}

}  // namespace

ProgressLine::ProgressLine(bool quiet)
    : ProgressLine(std::cerr, style_of_standard_error(quiet), Clock::now()) {}

ProgressLine::ProgressLine(std::ostream& out, Style style, Clock::time_point began)
    : out_(out), style_(style), began_(began), said_(began) {}

void ProgressLine::show(const std::string& what, double done, Clock::time_point now) {
  if (style_ == Style::kNone) return;
  if (done >= 1.0) return clear();
  if (style_ == Style::kPlain && now - said_ < kPlainEvery) return;
  said_ = now;
  std::string line = what;
  const double spent_s = std::chrono::duration<double>(now - began_).count();
  if (done > 0.0 && spent_s >= kForecastFrom_s) {
    line += ", " + std::to_string(std::lround(spent_s * (1.0 - done) / done)) + " s to go";
  }
  out_ << (style_ == Style::kTerminal ? "\r" + line + "\033[K" : line + "\n") << std::flush;
}

void ProgressLine::clear() {
  if (style_ == Style::kTerminal) out_ << "\r\033[K" << std::flush;
}

}  // namespace longreach
