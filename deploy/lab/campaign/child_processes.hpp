#pragma once
// Work in forked children, one a job and several at a time: a job that throws, aborts or crashes fails by
// itself. The children end with this process, however it ends. Call it while there is one thread.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace longreach {

struct ChildWork {
  std::function<void(std::size_t job)> run;  // in a child; an exception is a failure
  std::function<void(std::size_t job, const std::string& failure)> ended;  // here; empty: it did well
  std::function<void()> waited;                                            // here, at least once a second
};

/// Runs the jobs in their order. SIGINT, SIGTERM or SIGHUP ends what runs, without `ended`. Returns the
/// signal, or 0 when all jobs have ended. Throws std::runtime_error when no child can be started.
int run_in_children(const std::vector<std::size_t>& jobs, std::size_t at_a_time, const ChildWork& work);

}  // namespace longreach
