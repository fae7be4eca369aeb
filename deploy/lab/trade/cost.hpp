#pragma once
// Cost of a call on this machine.

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

namespace longreach {

/// ns per call of call(0) to call(times - 1), in the fastest of some rounds, which is the least disturbed.
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

/// Instructions per call, counted by single-stepping a child process (ptrace): exact, independent of the load
/// of the machine. NaN if the system does not permit it.
double instructions(int times, const std::function<void(int)>& call);

}  // namespace longreach
