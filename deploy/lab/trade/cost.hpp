#pragma once
// What a call costs on this machine.

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

namespace longreach {

/// ns of one of `times` calls, call(0) to call(times - 1), in the quickest of some rounds: the others were
/// disturbed.
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

/// Instructions of one of `times` calls, which a child process takes step by step (ptrace): exact, whatever
/// else the machine does. NaN where the system forbids it.
double instructions(int times, const std::function<void(int)>& call);

}  // namespace longreach
