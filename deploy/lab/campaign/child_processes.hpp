#pragma once
// Runs jobs in forked child processes, one per job and several in parallel, so that a job that throws, aborts
// or crashes does not affect the others. The children are killed if this process ends. Because
// run_in_children() forks, it must be called while this process has only one thread.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace longreach {

struct ChildWork {
  std::function<void(std::size_t job)> run;  // called in a child process; an exception counts as a failure
  /// Called in this process after each job; an empty `failure` means success.
  std::function<void(std::size_t job, const std::string& failure)> ended;
  std::function<void()> waited;  // called in this process at least once per second
};

/// Starts the jobs in order. SIGINT, SIGTERM or SIGHUP kills the running jobs; `ended` is not called for
/// these. Returns the signal, or 0 when all jobs have ended. Throws std::runtime_error if no child can be
/// started.
int run_in_children(const std::vector<std::size_t>& jobs, std::size_t at_a_time, const ChildWork& work);

}  // namespace longreach
