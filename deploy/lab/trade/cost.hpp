#pragma once
// Measures the cost of a function call on this machine.

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

namespace longreach {

/// Returns the mean duration of call(0) to call(times - 1), ns, in the fastest of several rounds, because
/// that round was least affected by other load.
template <class Call>
double cost_ns(int times, Call&& call) {
  constexpr int kRounds = 7;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < times; ++i) call(i);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - began;
    best = std::min(best, spent.count() / times);
  }
  return best;
}

/// Returns the number of instructions per call, counted by single-stepping a child process (ptrace). The
/// count is exact and does not depend on the load of the machine. Returns NaN if the system does not permit
/// ptrace.
double instructions(int times, const std::function<void(int)>& call);

}  // namespace longreach
