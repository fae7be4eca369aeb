// Deadlines, lateness, and what crosses between the loop and other threads.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <thread>

#include "common/loop/latest_value.hpp"
#include "common/loop/mailbox.hpp"
#include "common/loop/real_time_loop.hpp"

namespace longreach::real_time_loop_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

Time at(Duration t) { return Time(t); }

TEST(Deadlines, FollowEachOtherByThePeriodHoweverTheTicksJitter) {
  Deadlines deadlines(at(milliseconds(10)), milliseconds(1));
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(deadlines.next(), at(milliseconds(10 + i)));
    EXPECT_EQ(deadlines.advance(deadlines.next() + microseconds(i % 1000)), 0u);
  }
}

TEST(Deadlines, ATickThatEndsLateByLessThanAPeriodSkipsNothing) {
  Deadlines deadlines(at(milliseconds(10)), milliseconds(1));
  EXPECT_EQ(deadlines.advance(at(microseconds(11999))), 0u);
  EXPECT_EQ(deadlines.next(), at(milliseconds(11)));
}

TEST(Deadlines, SkipAndCountWhatWasMissedInsteadOfBursting) {
  Deadlines deadlines(at(milliseconds(10)), milliseconds(1));
  // The tick of 10 ms ends at 250.5 ms: 11 to 249 are lost, 250 runs late.
  EXPECT_EQ(deadlines.advance(at(microseconds(250500))), 239u);
  EXPECT_EQ(deadlines.next(), at(milliseconds(250)));
  EXPECT_EQ(deadlines.advance(at(microseconds(250600))), 0u);
  EXPECT_EQ(deadlines.next(), at(milliseconds(251)));
}

TEST(LoopFigures, CountTicksThatAreLateByMoreThan100Ms) {
  LoopFigures figures;
  for (const int ms : {0, 99, 100, 101, 5000}) figures.book(milliseconds(ms), Duration(0));
  EXPECT_EQ(figures.ticks, 5u);
  EXPECT_EQ(figures.ticks_late_100ms, 2u);
  EXPECT_EQ(figures.lateness_max, milliseconds(5000));
  EXPECT_EQ(figures.lateness_quantile_s(1.0), 5.0);
}

TEST(LoopFigures, QuantilesLieWithinAQuarterOctaveAboveTheTruth) {
  LoopFigures figures;
  EXPECT_EQ(figures.lateness_quantile_s(0.99), 0.0);
  for (int us = 1; us <= 10000; ++us) figures.book(microseconds(us), Duration(0));
  for (const double quantile : {0.1, 0.5, 0.9, 0.99}) {
    const double truth = 1e-6 * std::ceil(1e4 * quantile);
    EXPECT_GE(figures.lateness_quantile_s(quantile), truth * (1 - 1e-9)) << quantile;
    EXPECT_LE(figures.lateness_quantile_s(quantile), truth * std::exp2(0.25) * (1 + 1e-9)) << quantile;
  }
}

TEST(LoopFigures, SurviveNegativeAndHugeLateness) {
  LoopFigures figures;
  figures.book(Duration(-5), Duration(0));
  figures.book(Duration::max(), Duration(0));
  EXPECT_EQ(figures.ticks, 2u);
  EXPECT_EQ(figures.lateness.front(), 1u);
  EXPECT_EQ(figures.lateness.back(), 1u);
}

TEST(RealTimeLoop, TicksUntilItIsStoppedAndNeverBeforeADeadline) {
  std::atomic<bool> stop{false};
  RealTimeLoop loop(2000.0);
  const Time began = boottime_now();
  Time first{};
  loop.run(stop, [&](Time now, const LoopFigures& figures) {
    if (figures.ticks == 0) first = now;
    if (figures.ticks == 19) stop = true;
  });
  EXPECT_EQ(loop.figures().ticks, 20u);
  EXPECT_GE(first - began, microseconds(500));
  EXPECT_GE(boottime_now() - began, milliseconds(10));  // 20 periods of 0.5 ms
}

/// A host whose clock goes on as a test says.
struct Host {
  static inline Duration now{0};
  static inline Duration suspended{0};  // in the next sleep
  static Time read() { return Time{now}; }
  static void sleep(Time deadline) {
    now = std::max(now, deadline.time_since_epoch()) + suspended;
    suspended = Duration{0};
  }
};

TEST(RealTimeLoop, ReportsSuspendTimeAndMissedTicks) {
  std::atomic<bool> stop{false};
  RealTimeLoop loop(1000.0, {Host::read, Host::sleep});
  Time last{};
  loop.run(stop, [&](Time now, const LoopFigures& figures) {
    // The deadline that has come by then is kept at once.
    const auto passed = milliseconds(figures.ticks == 10 ? 60001 : figures.ticks == 11 ? 0 : 1);
    EXPECT_EQ(now - last, passed) << figures.ticks;
    last = now;
    if (figures.ticks == 9) Host::suspended = std::chrono::seconds(60);
    stop = figures.ticks == 20;
  });
  EXPECT_EQ(loop.figures().missed_ticks, 59999U);
  EXPECT_EQ(loop.figures().overdue_ticks, 60000U);
}

TEST(RealTimeLoop, CountsWhatItsOwnStepMakesLate) {
  std::atomic<bool> stop{false};
  RealTimeLoop loop(1000.0, {Host::read, Host::sleep});
  loop.run(stop, [&](Time, const LoopFigures& figures) {
    Host::now += microseconds(2500);  // every step takes two periods and a half
    stop = figures.ticks == 999;
  });
  EXPECT_NEAR(static_cast<double>(loop.figures().overdue_ticks), 1500.0, 3.0);
}

// In a time namespace whose CLOCK_BOOTTIME is 1000 s ahead, as after a suspension.
int ahead_in_a_namespace() {
  if (unshare(CLONE_NEWTIME) != 0) return 77;
  const int file = open("/proc/self/timens_offsets", O_WRONLY);
  const char* offset = "boottime 1000 0\n";
  if (file < 0 || write(file, offset, std::strlen(offset)) < 0) return 77;
  const pid_t child = fork();
  if (child == 0) {
    const auto steady = std::chrono::steady_clock::now().time_since_epoch();
    const Time now = boottime_now();
    const bool ahead = now.time_since_epoch() - steady > std::chrono::seconds(900);
    sleep_until(now + milliseconds(20));
    const Duration slept = boottime_now() - now;
    _exit(ahead && slept >= milliseconds(20) && slept < std::chrono::seconds(60) ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

TEST(SideClock, GoesOnWhileTheHostIsSuspended) {
  const pid_t child = fork();
  if (child == 0) _exit(ahead_in_a_namespace());
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  if (geteuid() != 0 && WEXITSTATUS(status) == 77) return;  // only root gets a time namespace
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(LatestValue, GivesTheNewestAndADefaultBeforeTheFirst) {
  LatestValue<int> value;
  EXPECT_EQ(value.read(), 0);
  value.write(1);
  value.write(2);
  EXPECT_EQ(value.read(), 2);
  EXPECT_EQ(value.read(), 2);
  for (int i = 3; i < 100; ++i) {
    value.write(i);
    if (i % 3 == 0) {
      EXPECT_EQ(value.read(), i);
    }
  }
}

TEST(LatestValue, NeverShowsAHalfWrittenValueNorAnOlderOne) {
  struct Pair {
    std::array<std::uint64_t, 32> same{};
  };
  LatestValue<Pair> value;
  constexpr std::uint64_t kLast = 50000;
  std::thread writer([&value] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      Pair pair;
      pair.same.fill(i);
      value.write(pair);
    }
  });
  std::uint64_t seen = 0;
  while (seen < kLast) {
    const Pair& pair = value.read();
    for (const auto v : pair.same) ASSERT_EQ(v, pair.same[0]);
    ASSERT_GE(pair.same[0], seen);
    seen = pair.same[0];
    std::this_thread::yield();
  }
  writer.join();
}

TEST(Mailbox, HandsACommandOverOnceAndBringsTheAnswerBack) {
  Mailbox<int, int> mailbox;
  std::atomic<bool> stop{false};
  int taken = 0;
  std::thread loop([&] {
    while (!stop) {
      if (const int* command = mailbox.take()) {
        ++taken;
        mailbox.answer(*command * 10);
      }
      std::this_thread::sleep_for(microseconds(100));
    }
  });
  std::thread other([&] {
    for (int i = 100; i < 120; ++i) EXPECT_EQ(mailbox.post(i, milliseconds(10000)), i * 10);
  });
  for (int i = 0; i < 20; ++i) EXPECT_EQ(mailbox.post(i, milliseconds(10000)), i * 10);
  other.join();
  stop = true;
  loop.join();
  EXPECT_EQ(taken, 40);
}

TEST(Mailbox, WithdrawsACommandThatNobodyTakes) {
  Mailbox<int, int> mailbox;
  EXPECT_FALSE(mailbox.post(1, milliseconds(5)));
  EXPECT_EQ(mailbox.take(), nullptr);  // a late loop does not carry out what was given up
}

}  // namespace
}  // namespace longreach::real_time_loop_test
