#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/utsname.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <thread>

#include "common/loop/real_time_loop.hpp"
#include "deploy/cli/doctor/doctor_checks.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {
namespace {

constexpr double kLoop_hz = 1000.0;
constexpr int kPriority = 50;  // loop.priority

std::string first_line(const char* file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

Finding examine_clock() {
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  const double resolution_s =
      static_cast<double>(resolution.tv_sec) + 1e-9 * static_cast<double>(resolution.tv_nsec);
  Finding out{FindingVerdict::kOk, "clock", "monotonic, resolution " + with_unit(1e9 * resolution_s, "ns")};
  if (const std::string source =
          first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource");
      !source.empty())
    out.text += ", source " + source;
  const std::time_t now = std::time(nullptr);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  out.text += "; wall clock " + std::string(text.data()) + ", used only for the log";
  if (resolution_s > 1e-5) {
    out.verdict = FindingVerdict::kWarning;
    out.advice = "select another kernel clock source: a 1 kHz loop needs a resolution of 10 us or better";
  }
  return out;
}

/// Runs in a thread of its own, so that its priority ends with the thread.
Finding examine_priority() {
  int error = 0;
  std::thread([&error] {
    sched_param parameters{};
    parameters.sched_priority = kPriority;
    error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  }).join();
  if (error == 0)
    return {FindingVerdict::kOk, "priority", "SCHED_FIFO " + std::to_string(kPriority) + " is permitted"};
  return {FindingVerdict::kWarning, "priority",
          "SCHED_FIFO " + std::to_string(kPriority) + " is not permitted: " + std::strerror(error),
          "grant it with LimitRTPRIO=50 in the systemd unit, 'rtprio 50' in /etc/security/limits.conf or "
          "CAP_SYS_NICE; or set loop.priority to 0"};
}

Finding examine_memory() {
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
  const int error = errno;
  if (locked) munlockall();
  if (locked) return {FindingVerdict::kOk, "memory", "locking is permitted"};
  return {FindingVerdict::kWarning, "memory",
          std::string("locking is not permitted: ") + std::strerror(error),
          "grant it with LimitMEMLOCK=infinity in the systemd unit, 'memlock unlimited' in "
          "/etc/security/limits.conf or CAP_IPC_LOCK; or set loop.lock_memory to false"};
}

Finding examine_processor() {
  const unsigned cores = std::thread::hardware_concurrency();
  Finding out{FindingVerdict::kOk, "processor", std::to_string(cores) + (cores == 1 ? " core" : " cores")};
  const std::string governor = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  const std::string isolated = first_line("/sys/devices/system/cpu/isolated");
  out.text += governor.empty() ? ", no frequency governor visible" : ", governor " + governor;
  out.text += isolated.empty() ? ", no isolated cores" : ", isolated cores: " + isolated;
  utsname system{};
  if (uname(&system) == 0)
    out.text += std::string(", Linux ") + system.release +
                (std::strstr(system.version, "PREEMPT_RT") != nullptr ? " PREEMPT_RT" : "");
  if (cores < 2) {
    out.verdict = FindingVerdict::kWarning;
    out.advice = "use a machine with at least two cores: the control loop needs a core of its own";
  } else if (!governor.empty() && governor != "performance") {
    out.verdict = FindingVerdict::kWarning;
    out.advice =
        "set the governor to performance (cpupower frequency-set -g performance): cores that run at a low "
        "frequency wake up late";
  }
  return out;
}

/// An empty loop, which shows the best timing that this machine can achieve.
Finding examine_loop(double seconds) {
  std::atomic<bool> end{false};
  std::vector<double> late_s;
  late_s.reserve(static_cast<std::size_t>(2.0 * seconds * kLoop_hz));
  LoopFigures figures;
  std::thread([&] {
    (void)ask_for_real_time({.rate_hz = kLoop_hz, .priority = kPriority, .lock_memory = false});
    const Time began = boottime_now();
    const Duration period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / kLoop_hz));
    for (Deadlines due(began + period, period); to_seconds(due.next() - began) < seconds;) {
      timespec wake{};
      const auto ns = due.next().time_since_epoch().count();
      wake.tv_sec = static_cast<time_t>(ns / 1'000'000'000);
      wake.tv_nsec = static_cast<long>(ns % 1'000'000'000);
      while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
      }
      const Time now = boottime_now();
      late_s.push_back(to_seconds(now - due.next()));
      figures.book(now - due.next(), Duration{0});
      figures.missed_ticks += due.advance(boottime_now());
    }
  }).join();
  const double p99_s = figures.lateness_quantile_s(0.99);
  Finding out{FindingVerdict::kOk, "bare loop",
              "1 kHz for " + with_unit(seconds, "s") + ": 99 % of ticks late by at most " +
                  with_unit(p99_s, "s") + ", worst " + with_unit(to_seconds(figures.lateness_max), "s") +
                  ", " + std::to_string(figures.missed_ticks) + " missed",
              "", histogram_of(late_s)};
  if (p99_s > 1.0 / kLoop_hz) {
    out.verdict = FindingVerdict::kWarning;
    out.advice =
        "close other programs, give the loop real-time priority, isolate a core, or lower "
        "loop.rate_hz";
  }
  // The programs hold if the time between two ticks exceeds their gap timer.
  constexpr double kGap_s = 0.1, kNear = 0.5;
  if (to_seconds(figures.lateness_max) > kNear * kGap_s) {
    out.verdict = FindingVerdict::kWarning;
    out.advice =
        "a loop on this machine can stall for about as long as the gap timer (safety.gap_s, 0.1 s) or "
        "longer: close other programs, or give the loop real-time priority";
  }
  return out;
}

}  // namespace

Section examine_machine(double seconds) {
  return {
      "This machine",
      {examine_clock(), examine_priority(), examine_memory(), examine_processor(), examine_loop(seconds)}};
}

}  // namespace longreach
