#pragma once
// Calls a step at a fixed rate on absolute deadlines of CLOCK_MONOTONIC, in the calling thread.

#include <atomic>
#include <string>
#include <vector>

#include "common/core/loop_config.hpp"
#include "common/io/loop_figures.hpp"

namespace longreach {

/// Now on CLOCK_MONOTONIC: the one clock of a side.
Time monotonic_now();

/// Real-time priority and locked memory for the calling thread, as far as the system permits. Returns what it
/// did not permit, one sentence each, with what to do about it.
std::vector<std::string> ask_for_real_time(const LoopConfig& config);

class RealTimeLoop {
 public:
  explicit RealTimeLoop(double rate_hz) : period_(from_seconds(1.0 / rate_hz)) {}

  /// step(Time now, const LoopFigures&) a period until `stop`.
  template <class Step>
  void run(const std::atomic<bool>& stop, Step step) {
    Deadlines deadlines(monotonic_now() + period_, period_);
    while (!stop.load(std::memory_order_relaxed)) {
      sleep_until(deadlines.next());
      const Time now = monotonic_now();
      step(now, figures_);
      const Time end = monotonic_now();
      figures_.book(now - deadlines.next(), end - now);
      figures_.missed_ticks += deadlines.advance(end);
    }
  }

  [[nodiscard]] const LoopFigures& figures() const { return figures_; }

 private:
  static void sleep_until(Time deadline);

  Duration period_;
  LoopFigures figures_{};
};

}  // namespace longreach
