#include "common/safety/delay_watch.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "common/core/random.hpp"

namespace longreach::delay_watch_test {
namespace {

/// A side that hears `hz` datagrams a second whose round trip is `rtt(t)`, s, for `seconds`; ticks at 1 kHz.
struct Reception {
  DelayWatch watch;
  double t_s = 0.0;
  double received_s = 0.0;

  /// When it rose by more than the bound first; none: never.
  std::optional<double> listen(double seconds, double hz, const std::function<double(double)>& rtt,
                               double bound_s = 1.0) {
    std::optional<double> rose;
    for (const double end_s = t_s + seconds; t_s < end_s; t_s += 1e-3) {
      const Time now = Time{std::chrono::hours(1)} + from_seconds(t_s);
      for (; hz > 0.0 && received_s <= t_s; received_s += 1.0 / hz) watch.add(now, from_seconds(rtt(t_s)));
      watch.step(now);
      if (!rose && watch.rose(bound_s)) rose = t_s;
    }
    return rose;
  }
};

TEST(DelayWatch, SeesAStepByMoreThanTheBoundWithinHalfASecond) {
  for (const double hz : {30.0, 300.0, 4000.0}) {
    for (const double step_s : {0.9, 1.1, 25.0}) {
      Reception h;
      const auto rose = h.listen(20.0, hz, [&](double t) { return t < 10.0 ? 0.05 : 0.05 + step_s; });
      EXPECT_EQ(rose.has_value(), step_s > 1.0) << hz << ' ' << step_s;
      if (rose) {
        EXPECT_NEAR(*rose, 10.25, 0.1) << hz;
      }
    }
  }
}

TEST(DelayWatch, DetectsRampAboveAllowedRise) {
  for (const double slope : {0.0009, 0.01, 0.5}) {
    Reception h;
    const auto rose = h.listen(150.0, 100.0, [&](double t) { return 0.05 + slope * t; });
    EXPECT_EQ(rose.has_value(), slope > 0.001) << slope;
    if (rose) {
      EXPECT_NEAR(*rose, 1.0 / (slope - 0.001), 1.0) << slope;
    }
  }
}

TEST(DelayWatch, TheLeastIsOfTheEngagement) {
  Reception h;
  h.listen(5.0, 100.0, [](double) { return 0.05; });
  EXPECT_TRUE(h.listen(1.0, 100.0, [](double) { return 25.0; }));
  h.watch.rebase();
  EXPECT_FALSE(h.listen(5.0, 100.0, [](double) { return 25.0; })) << "accepted by the engagement";
  EXPECT_NEAR(h.watch.least_s().value_or(0.0), 25.0, 0.01);
  EXPECT_TRUE(h.listen(1.0, 100.0, [](double) { return 26.1; }));
}

TEST(DelayWatch, WhatComesRightAfterTheEngagementIsNotAccepted) {
  Reception h;
  h.listen(5.0, 100.0, [](double) { return 0.05; });
  h.watch.rebase();
  EXPECT_TRUE(h.listen(1.0, 100.0, [](double) { return 1.2; }));
}

TEST(DelayWatch, ASmallerDelayIsTheLeastFromThenOn) {
  Reception h;
  EXPECT_FALSE(h.listen(5.0, 100.0, [](double) { return 3.0; }));
  EXPECT_FALSE(h.listen(5.0, 100.0, [](double) { return 0.1; }));
  EXPECT_TRUE(h.listen(5.0, 100.0, [](double) { return 1.2; }));
}

TEST(DelayWatch, NeitherFewNorOddDatagramsNorSilenceSetTheLeast) {
  Random random(1);
  Reception h;
  // One in five tells too little, and the first after a silence do.
  const auto odd = [&](double t) { return random.chance(0.2) || (t > 20.0 && t < 20.05) ? 0.0 : 2.6; };
  EXPECT_FALSE(h.listen(10.0, 100.0, odd));
  EXPECT_FALSE(h.listen(10.0, 0.0, odd));
  h.received_s = h.t_s;
  EXPECT_FALSE(h.listen(10.0, 100.0, odd));
  EXPECT_NEAR(h.watch.least_s().value_or(0.0), 2.6, 0.02);
}

TEST(DelayWatch, JitterAndLossOfTheLinksThatExistAreNoRise) {
  Random random(2);
  Reception h;
  EXPECT_FALSE(h.listen(
      600.0, 30.0, [&](double) { return 3.0 + 0.1 * std::abs(random.normal()); }, 0.2));
}

TEST(DelayWatch, ARoundTripThatIsNotKnownIsNone) {
  Reception h;
  for (int i = 0; i < 1000; ++i) {
    const Time now{std::chrono::milliseconds(i)};
    h.watch.add(now, Duration{-1});
    h.watch.step(now);
  }
  EXPECT_FALSE(h.watch.median_s());
}

}  // namespace
}  // namespace longreach::delay_watch_test
