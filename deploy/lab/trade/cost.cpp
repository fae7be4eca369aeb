#include "deploy/lab/trade/cost.hpp"

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace longreach {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr long kMost = 1'000'000;  // about ten seconds

/// Never returns: stops itself before and after the counted calls, and exits.
[[noreturn]] void be_counted(int times, const std::function<void(int)>& call) {
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
  call(0);  // one-time work of the first call is not counted
  raise(SIGSTOP);
  for (int i = 0; i < times; ++i) call(i);
  raise(SIGSTOP);
  _exit(0);
}

/// Counts between the two stops.
double count(int times, const std::function<void(int)>& call) {
  const pid_t child = fork();
  if (child < 0) return kUnknown;
  if (child == 0) be_counted(times, call);
  int status = 0;
  long steps = 0;
  bool began = waitpid(child, &status, 0) == child && WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP;
  bool ended = false;
  while (began && !ended && steps < kMost) {
    if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0) break;
    if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) break;
    ended = WSTOPSIG(status) == SIGSTOP;
    ++steps;
  }
  if (!WIFEXITED(status) && !WIFSIGNALED(status)) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return ended ? static_cast<double>(steps) : kUnknown;
}

}  // namespace

double instructions(int times, const std::function<void(int)>& call) {
  return (count(times, call) - count(0, call)) / times;
}

}  // namespace longreach
