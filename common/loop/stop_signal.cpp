#include "common/loop/stop_signal.hpp"

#include <unistd.h>

#include <csignal>

namespace longreach {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

std::atomic<int> signals{0};

// Async-signal-safe: uses only atomics and _exit. SIGHUP is not counted, because a closing terminal may send
// it several times.
void request_stop(int signal) {
  if (signal != SIGHUP && signals.fetch_add(1) >= 2) _exit(128 + signal);
  requested.store(true);
}

}  // namespace

std::atomic<bool>& stop_requested() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction present {};
    const bool ignored = sigaction(SIGHUP, nullptr, &present) == 0 && present.sa_handler == SIG_IGN;
    if (!ignored) sigaction(SIGHUP, &action, nullptr);  // nohup(1) sets it to be ignored
    // The end of a process that reads the output must not end a program that controls a robot.
    std::signal(SIGPIPE, SIG_IGN);
    return true;
  }();
  static_cast<void>(installed);
  return requested;
}

}  // namespace longreach
