#include "common/loop/real_time_loop.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <cerrno>
#include <cstring>

namespace longreach {

std::vector<std::string> ask_for_real_time(const LoopConfig& config) {
  std::vector<std::string> notes;
  if (config.priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = static_cast<int>(config.priority);
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    if (error != 0) {
      notes.push_back(
          std::string("no real-time priority (") + std::strerror(error) +
          "): ticks may be late; grant it with `ulimit -r` or CAP_SYS_NICE, or set loop.priority to 0");
    }
  }
  // With MCL_ONFAULT only pages that are used are locked, not the entire stack of every thread.
  if (config.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) {
    notes.push_back(std::string("memory is not locked (") + std::strerror(errno) +
                    "): ticks may be late; grant it with `ulimit -l`, or set loop.lock_memory to false");
  }
  return notes;
}

void sleep_until(Time deadline) {
  const auto ns = deadline.time_since_epoch().count();
  timespec t{};
  t.tv_sec = static_cast<time_t>(ns / 1'000'000'000);
  t.tv_nsec = static_cast<long>(ns % 1'000'000'000);
  while (clock_nanosleep(CLOCK_BOOTTIME, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

}  // namespace longreach
