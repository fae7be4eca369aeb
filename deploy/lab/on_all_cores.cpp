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
  std::once_flag failed;
  std::exception_ptr failure;
  const auto work = [&](bool reports) {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        if (reports && progress) progress(static_cast<double>(i) / static_cast<double>(count));
        one(i);
      }
    } catch (...) {
      next = count;
      std::call_once(failed, [&] { failure = std::current_exception(); });
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
