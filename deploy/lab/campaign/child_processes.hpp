#pragma once
// Runs jobs in forked child processes, one per job and several in parallel: a job that throws, aborts or
// crashes only fails itself. The children end with this process. Call it while there is one thread.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace longreach {

struct ChildWork {
  std::function<void(std::size_t job)> run;  // in a child; an exception is a failure
  std::function<void(std::size_t job, const std::string& failure)> ended;  // in this process; empty: success
  std::function<void()> waited;  // in this process, at least once a second
};

/// Runs the jobs in order. SIGINT, SIGTERM or SIGHUP ends running jobs without `ended`. Returns the signal,
/// or 0 when all jobs have ended. Throws std::runtime_error if no child can be started.
int run_in_children(const std::vector<std::size_t>& jobs, std::size_t at_a_time, const ChildWork& work);

}  // namespace longreach
