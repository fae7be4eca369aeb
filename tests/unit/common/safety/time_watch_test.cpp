#include "common/safety/time_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace longreach::time_watch_test {
namespace {

using std::chrono::milliseconds;

constexpr double kGap_s = 0.1;

struct Side {
  TimeWatch watch{1000.0};
  Time now{std::chrono::hours(1)};
  std::uint64_t overdue = 0;

  void tick(int ms, std::uint64_t late = 0) {
    now += milliseconds(ms);
    overdue += late;
    watch.step(now, kGap_s, overdue);
  }
  void receive(std::vector<double> rtts_s) {
    std::vector<Received<int>> received(rtts_s.size());
    for (std::size_t i = 0; i < rtts_s.size(); ++i) received[i].rtt = from_seconds(rtts_s[i]);
    watch.receive(now, std::span<const Received<int>>(received));
  }
};

// `link clear` from the delay of the Moon: for a round trip what was under way comes among what is fresh, now
// fewer, now more of it.
TEST(TimeWatch, AFallOfTheDelayIsNoRise) {
  Side side;
  const auto receive = [&](double echo_age_s, int times) {
    std::vector<Received<int>> received(static_cast<std::size_t>(times));
    for (auto& one : received) {
      one.rtt = from_seconds(echo_age_s);
      one.echo_sent = side.now - one.rtt;
    }
    side.watch.receive(side.now, std::span<const Received<int>>(received));
  };
  for (int i = 0; i < 3000; ++i) receive(2.6, 1), side.tick(1);
  side.watch.rebase();
  for (int i = 0; i < 4000; ++i) {
    const bool under_way = i < 2600, few = i < 1000;
    receive(0.01, few ? 2 : 1);
    if (under_way) receive(2.6, few ? 1 : 2);
    side.tick(1);
    ASSERT_FALSE(side.watch.delay().rose(1.0)) << i << " ms after";
  }
  EXPECT_LT(side.watch.delay().median_s().value_or(9.0), 0.02);
  side.tick(1500);
  for (int i = 0; i < 1000; ++i) receive(1.5, 1), side.tick(1);
  EXPECT_TRUE(side.watch.delay().rose(1.0)) << "a rise is one still";
}

TEST(TimeWatch, LateTickBeyondGapTimerIsStallFromPreviousTick) {
  Side side;
  EXPECT_FALSE(side.watch.stalls(side.now + std::chrono::hours(9), kGap_s))
      << "there was none before the first";
  side.tick(0);
  EXPECT_FALSE(side.watch.passed_s());
  EXPECT_FALSE(side.watch.stalled_since());
  side.tick(100);
  EXPECT_FALSE(side.watch.stalled_since()) << "at the gap timer, not over it";
  EXPECT_DOUBLE_EQ(side.watch.passed_s().value_or(0.0), 0.1);
  const Time before = side.now;
  EXPECT_TRUE(side.watch.stalls(before + milliseconds(101), kGap_s));
  EXPECT_FALSE(side.watch.stalls(before + milliseconds(99), kGap_s));
  side.tick(101);
  EXPECT_EQ(side.watch.stalled_since(), before);
  EXPECT_DOUBLE_EQ(side.watch.passed_s().value_or(0.0), 0.101);
  side.tick(1);
  EXPECT_FALSE(side.watch.stalled_since()) << "of this tick alone";
}

TEST(TimeWatch, LateTicksBeforeAStallDoNotCountAfterIt) {
  Side side;
  for (int i = 0; i < 520; ++i) side.tick(1, 1);
  EXPECT_TRUE(side.watch.overrun());
  side.tick(200, 199);
  EXPECT_FALSE(side.watch.overrun());
  for (int i = 0; i < 480; ++i) side.tick(1, 1);
  EXPECT_FALSE(side.watch.overrun());
  for (int i = 0; i < 30; ++i) side.tick(1, 1);
  EXPECT_TRUE(side.watch.overrun());
}

TEST(TimeWatch, HearsTheRoundTripsOfWhatComesUntilTheNextEngagement) {
  Side side;
  for (int i = 0; i < 600; ++i) {
    side.receive({0.05, -1.0, 0.05, 0.9});
    side.tick(1);
  }
  EXPECT_NEAR(side.watch.delay().median_s().value_or(0.0), 0.05, 1e-6);
  EXPECT_NEAR(side.watch.delay().least_s().value_or(0.0), 0.05, 1e-3);
  for (int i = 0; i < 600; ++i) {
    side.receive({0.4});
    side.tick(1);
  }
  EXPECT_NEAR(side.watch.delay().least_s().value_or(0.0), 0.05, 2e-3);
  side.watch.rebase();
  EXPECT_NEAR(side.watch.delay().least_s().value_or(0.0), 0.4, 1e-6);
}

}  // namespace
}  // namespace longreach::time_watch_test
