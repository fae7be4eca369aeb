#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/random.hpp"
#include "tests/unit/common/link/playout_run.hpp"

namespace longreach::playout_link_test {
namespace {

constexpr double kStepM = kGoalSpeedMPerS * 0.005;  // between two goals

/// Largest and least speed of the played goal over its true speed, a tick at a time, from `from_s` to `to_s`.
struct Speeds {
  double least = 1e9, most = -1e9;
};

Speeds speeds(const std::vector<PlayedTick>& ticks, double from_s, double to_s) {
  Speeds s;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    if (ticks[i].now_s < from_s || ticks[i].now_s > to_s) continue;
    const double speed = (ticks[i].x_m - ticks[i - 1].x_m) / (ticks[i].now_s - ticks[i - 1].now_s);
    s.least = std::min(s.least, speed / kGoalSpeedMPerS);
    s.most = std::max(s.most, speed / kGoalSpeedMPerS);
  }
  return s;
}

TEST(PlayoutLink, NeverGoesBackOnAnyLink) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const double sd_s = random.uniform(0.0, 0.2);
    const bool adaptive = random.chance(0.5);
    const auto ticks = run({.config = {.adaptive = adaptive, .fixed_delay_s = random.uniform(0.0, 0.3)},
                            .duration_s = 10.0,
                            .delay_s = [&](double) {
                              return random.chance(0.3) ? -1.0 : std::max(0.0, 0.3 + sd_s * random.normal());
                            }});
    for (std::size_t i = 1; i < ticks.size(); ++i) {
      ASSERT_GE(ticks[i].sequence, ticks[i - 1].sequence) << "seed " << seed << " at " << ticks[i].now_s;
      ASSERT_LE(ticks[i].sequence, ticks[i].newest);
    }
  }
}

TEST(PlayoutLink, LinearMotionIsExactInSpiteOfJitterLossAndReordering) {
  Random random(3);
  const auto ticks = run({.config = {.adaptive = false, .fixed_delay_s = 0.15}, .delay_s = [&](double) {
                            return random.chance(0.05) ? -1.0 : 0.4 + random.uniform(0.0, 0.1);
                          }});
  for (const PlayedTick& t : ticks) ASSERT_NEAR(t.x_m, kStepM * t.sequence, 1e-12);
  // Every arrival is in time, so the goal runs as the sender's hand did; the slew alone shows.
  const Speeds s = speeds(ticks, 1.0, 20.0);
  EXPECT_GE(s.least, 0.95 - 1e-6);
  EXPECT_LE(s.most, 1.05 + 1e-6);
  // And at the promised time: sent 0.4 s (least delay) and 0.15 s ago.
  const PlayedTick& t = ticks[15000];
  EXPECT_NEAR(t.x_m, kGoalSpeedMPerS * (t.now_s - 0.55 + 0.005), kGoalSpeedMPerS * 0.003);
}

TEST(PlayoutLink, EndsAtTheLastGoalAtThirtyPercentLoss) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const auto ticks = run({.config = {.adaptive = seed % 2 == 0, .fixed_delay_s = 0.05},
                            .duration_s = 3.0,
                            .delay_s = [&](double sent_s) {
                              if (sent_s < 2.99 && random.chance(0.3)) return -1.0;
                              return 0.2 + random.uniform(0.0, 0.02);
                            }});
    EXPECT_EQ(ticks.back().sequence, 600.0) << seed;
    EXPECT_EQ(ticks.back().x_m, kStepM * 600.0) << seed;
  }
}

TEST(PlayoutLink, AdaptiveDelayIsZeroWithoutJitter) {
  const auto ticks = run({.delay_s = [](double) { return 1.3; }});
  for (const PlayedTick& t : ticks) ASSERT_EQ(t.delay_s, 0.0);
}

TEST(PlayoutLink, AdaptiveDelayIsTheQuantileOfTheLateness) {
  // Lateness uniform over 0 to 100 ms: its quantiles are known; seen on ticks of 1 ms.
  for (const double quantile : {0.5, 0.9, 0.99}) {
    Random random(4);
    const auto ticks = run({.config = {.quantile = quantile}, .duration_s = 40.0, .delay_s = [&](double) {
                              return 0.5 + random.uniform(0.0, 0.1);
                            }});
    for (const PlayedTick& t : ticks) {
      // 1000 samples: the quantile's own deviation is sqrt(q (1 - q) / 1000) of the range.
      const double tolerance_s = 0.001 + 0.1 * 4.0 * std::sqrt(quantile * (1.0 - quantile) / 1000.0);
      if (t.now_s > 15.0 && t.now_s < 40.0) {
        ASSERT_NEAR(t.delay_s, 0.1 * quantile, tolerance_s) << t.now_s;
      }
    }
  }
}

TEST(PlayoutLink, AdaptiveDelayMakesMostGoalsArriveInTime) {
  Random random(5);
  const auto ticks = run(
      {.duration_s = 40.0, .delay_s = [&](double) { return std::max(0.0, 0.3 + 0.02 * random.normal()); }});
  int starved = 0, seen = 0;
  for (const PlayedTick& t : ticks) {
    if (t.now_s < 15.0 || t.now_s > 40.0) continue;
    ++seen;
    starved += t.sequence >= t.newest ? 1 : 0;
  }
  // Overtaking makes starvation rarer still than the 1 % of the goals that come too late.
  EXPECT_LT(starved, seen / 100);
}

TEST(PlayoutLink, AdaptiveDelayKeepsToItsLimit) {
  Random random(6);
  const auto ticks = run(
      {.config = {.delay_max_s = 0.05}, .delay_s = [&](double) { return 0.2 + random.uniform(0.0, 0.3); }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 10.0) {
      ASSERT_LE(t.delay_s, 0.05 + 0.003);
    }
  }
}

TEST(PlayoutLink, FollowsAClockDriftOf500PartsPerMillion) {
  for (const double drift : {5e-4, -5e-4}) {
    const auto ticks =
        run({.duration_s = 60.0, .clock_ratio = 1.0 + drift, .delay_s = [](double) { return 0.5; }});
    for (const PlayedTick& t : ticks) {
      if (t.now_s < 10.0 || t.now_s > 59.0) continue;
      // Newest goal at hand: not more than a window's drift and two periods old.
      ASSERT_GE(t.sequence, t.newest - 3.0) << t.now_s;
      // A minimum that falls is known at once; one that rises when the old one has aged. Ticks of 1 ms.
      ASSERT_LE(t.delay_s, drift < 0.0 ? 0.0015 : 5e-4 * 10.0 + 0.002);
    }
  }
}

TEST(PlayoutLink, AStepUpOfTheDelayIsPlayedOnArrivalAndThenFollowed) {
  Random random(7);
  const auto ticks = run({.duration_s = 60.0, .delay_s = [&](double sent_s) {
                            return (sent_s < 15.0 ? 0.4 : 5.4) + random.uniform(0.0, 0.02);
                          }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 15.5 && t.now_s < 20.3) {
      ASSERT_EQ(t.sequence, 3000.0) << "held";
    }
    if (t.now_s > 20.5 && t.now_s < 59.0) {
      ASSERT_GE(t.sequence, t.newest - 8.0) << "played at " << t.now_s;
    }
    if (t.now_s > 36.0 && t.now_s < 59.0) {
      ASSERT_NEAR(t.delay_s, 0.02 * PlayoutConfig{}.quantile, 0.0025) << "smoothed again at " << t.now_s;
    }
  }
  const Speeds s = speeds(ticks, 40.0, 59.0);
  EXPECT_LE(s.most, 10.0) << "1 % of the goals still come too late";
}

TEST(PlayoutLink, AStepDownOfTheDelayIsFollowedAtOnce) {
  const auto ticks =
      run({.duration_s = 40.0, .delay_s = [](double sent_s) { return sent_s < 15.0 ? 5.4 : 0.4; }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 15.41 && t.now_s < 40.0) {
      ASSERT_EQ(t.sequence, t.newest) << t.now_s;
      ASSERT_EQ(t.delay_s, 0.0) << t.now_s;
    }
  }
}

TEST(PlayoutLink, ASlowerLinkThatHasBecomeTheNormIsNotLate) {
  // The step is made up for once, by delay or by the older minimum's end: never by both.
  const auto ticks =
      run({.duration_s = 40.0, .delay_s = [](double sent_s) { return sent_s < 15.0 ? 0.4 : 0.7; }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 16.0 && t.now_s < 40.0) {
      ASSERT_GE(t.sequence, t.newest - 1.0) << t.now_s;
    }
  }
}

TEST(PlayoutLink, AFasterLinkIsFollowedSmoothly) {
  // The overtaken goals are late until 15.6 s, remembered for 5 s; then 0.2 s at 0.05 s/s.
  const auto ticks =
      run({.duration_s = 30.0, .delay_s = [](double sent_s) { return sent_s < 15.0 ? 0.6 : 0.4; }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 15.6 + 5.0 + 4.2 && t.now_s < 30.0) {
      ASSERT_EQ(t.delay_s, 0.0) << t.now_s;
    }
  }
}

TEST(PlayoutLink, ForgetsJitterThatEndedFiveSecondsAgo) {
  Random random(8);
  const auto ticks = run({.duration_s = 30.0, .delay_s = [&](double sent_s) {
                            return 0.5 + (sent_s < 15.0 ? random.uniform(0.0, 0.1) : 0.0);
                          }});
  for (const PlayedTick& t : ticks) {
    if (t.now_s > 15.6 + 5.0 + 2.0) {
      ASSERT_LE(t.delay_s, 0.001) << t.now_s;
    }
  }
}

TEST(PlayoutLink, AChangeOfTheDelayDoesNotMakeTheGoalJump) {
  Playout playout({.adaptive = false, .fixed_delay_s = 0.2});
  double last_x = 0.0;
  int arrived = 0;
  for (int tick = 0; tick < 30000; ++tick) {
    const Time now{from_seconds(0.001 * tick)};
    if (tick % 5 == 0) {
      Vector3 goal = Vector3::Zero();
      goal.x() = kStepM * ++arrived;
      playout.push(now, PeerTime{from_seconds(0.001 * tick)}, static_cast<std::uint64_t>(arrived), goal);
    }
    if (tick == 5000) playout.configure({.adaptive = false, .fixed_delay_s = 0.5});
    if (tick == 20000) playout.configure({.adaptive = false, .fixed_delay_s = 0.1});
    const double x = playout.play(now)->goal.x();
    if (tick > 300) {
      ASSERT_GE(x - last_x, 0.949e-3 * kGoalSpeedMPerS) << tick;
      ASSERT_LE(x - last_x, 1.051e-3 * kGoalSpeedMPerS) << tick;
    }
    if (tick == 19999) {
      EXPECT_NEAR(playout.delay_s(), 0.5, 1e-9);
    }
    last_x = x;
  }
  EXPECT_NEAR(playout.delay_s(), 0.1, 1e-9);
}

}  // namespace
}  // namespace longreach::playout_link_test
