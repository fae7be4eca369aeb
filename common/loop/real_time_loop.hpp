#pragma once
// Calls a step at a fixed rate in the calling thread, with absolute deadlines on the side's clock.

#include <atomic>
#include <string>
#include <vector>

#include "common/loop/loop_figures.hpp"
#include "common/loop/side_clock.hpp"
#include "schema/config_common.hpp"

namespace longreach {

/// Sleeps until `deadline` on the side's clock.
void sleep_until(Time deadline);

/// Requests real-time priority and locked memory for the calling thread. Returns one sentence with a remedy
/// for each request that the system refused.
std::vector<std::string> ask_for_real_time(const LoopConfig& config);

/// Time source of a loop. Tests pass a simulated clock.
struct LoopClock {
  Time (*now)() = boottime_now;
  void (*sleep_until)(Time) = longreach::sleep_until;
};

class RealTimeLoop {
 public:
  explicit RealTimeLoop(double rate_hz, const LoopClock& clock = {})
      : period_(from_seconds(1.0 / rate_hz)), clock_(clock) {}

  /// Calls step(Time now, const LoopFigures&) once per period until `stop` is true.
  template <class Step>
  void run(const std::atomic<bool>& stop, Step step) {
    Deadlines deadlines(clock_.now() + period_, period_);
    while (!stop.load(std::memory_order_relaxed)) {
      clock_.sleep_until(deadlines.next());
      const Time now = clock_.now();
      step(now, figures_);
      const Time end = clock_.now();
      const Duration late = now - deadlines.next();
      figures_.book(late, end - now);
      const std::uint64_t missed = deadlines.advance(end);
      figures_.missed_ticks += missed;
      figures_.overdue_ticks += missed + (late > period_ ? 1 : 0);
    }
  }

  [[nodiscard]] const LoopFigures& figures() const { return figures_; }

 private:
  Duration period_;
  LoopClock clock_;
  LoopFigures figures_{};
};

}  // namespace longreach
