#include "deploy/lab/on_all_cores.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace longreach {
namespace {

/// Number of cores that no call uses at present; the thread of the first call occupies one.
std::atomic<int>& idle_cores() {
  static std::atomic<int> cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency())) - 1;
  return cores;
}

bool take_core() {
  if (idle_cores().fetch_sub(1) > 0) return true;
  ++idle_cores();
  return false;
}

}  // namespace

void on_all_cores(std::size_t count, const std::function<void(std::size_t)>& one,
                  const std::function<void(double)>& progress) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t failed = count;
  std::exception_ptr failure;
  const auto work = [&](bool reports) {
    std::size_t i = 0;
    try {
      while ((i = next++) < count) {
        if (reports && progress) progress(static_cast<double>(i) / static_cast<double>(count));
        one(i);
      }
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (i < failed) failure = std::current_exception();
      failed = std::min(failed, i);
    }
  };
  {
    std::vector<std::jthread> others;
    while (others.size() + 1 < count && take_core())
      others.emplace_back([&] {
        work(false);
        ++idle_cores();
      });
    work(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace longreach
