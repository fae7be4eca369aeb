// What the impairment promises exactly. Statistics: impairment_statistics_test.cpp.

#include "common/link/impairment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace longreach::impairment_test {
namespace {

using Bytes = std::vector<std::byte>;

Time at(double s) { return Time{from_seconds(s)}; }

Bytes bytes_of(int value, std::size_t size = 4) { return Bytes(size, static_cast<std::byte>(value)); }

std::vector<int> drain(Impairment& impairment, double now_s) {
  std::vector<int> values;
  while (const auto out = impairment.pop(at(now_s))) {
    values.push_back(out->empty() ? -1 : std::to_integer<int>(out->front()));
  }
  return values;
}

using Values = std::vector<int>;

TEST(Impairment, AllZeroPassesEverythingAtOnceInOrder) {
  Impairment impairment({}, Random(1));
  for (int i = 0; i < 50; ++i) impairment.push(at(1.0), bytes_of(i));
  const Values out = drain(impairment, 1.0);
  ASSERT_EQ(out.size(), 50U);
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
  EXPECT_EQ(impairment.counts().in, 50U);
  EXPECT_EQ(impairment.counts().out, 50U);
}

TEST(Impairment, HoldsADatagramForTheDelayToTheNanosecond) {
  Impairment impairment({.delay_s = 1.3}, Random(1));
  impairment.push(at(2.0), bytes_of(7));
  EXPECT_EQ(drain(impairment, 3.3 - 1e-9), Values{});
  EXPECT_EQ(drain(impairment, 3.3), Values{7});
  EXPECT_EQ(drain(impairment, 100.0), Values{});
}

TEST(Impairment, EqualDueTimesKeepTheOrderOfArrival) {
  Impairment impairment({.delay_s = 0.5}, Random(1));
  for (int i = 0; i < 200; ++i) impairment.push(at(0.0), bytes_of(i));
  const Values out = drain(impairment, 0.5);
  ASSERT_EQ(out.size(), 200U);
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
}

TEST(Impairment, AllBytesComeOutAsTheyWentIn) {
  Impairment impairment({.delay_s = 0.1}, Random(1));
  Bytes in(508);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<std::byte>(i * 31 + 7);
  impairment.push(at(0.0), in);
  const auto out = impairment.pop(at(0.1));
  ASSERT_TRUE(out);
  EXPECT_TRUE(std::equal(in.begin(), in.end(), out->begin(), out->end()));
}

TEST(Impairment, OversizeComesOutCutButStillTooLong) {
  Impairment impairment({}, Random(1));
  for (const std::size_t size : {std::size_t{601}, std::size_t{1500}, std::size_t{65507}}) {
    impairment.push(at(0.0), bytes_of(1, size));
    EXPECT_EQ(impairment.pop(at(0.0)).value().size(), 600U);
  }
  impairment.push(at(0.0), bytes_of(1, 600));
  impairment.push(at(0.0), Bytes{});
  EXPECT_EQ(impairment.pop(at(0.0)).value().size(), 600U);
  EXPECT_EQ(impairment.pop(at(0.0)).value().size(), 0U);
}

TEST(Impairment, EmptyDatagramsSurviveEveryEffect) {
  Impairment impairment({.jitter_s = 0.01, .duplicate = 1.0, .corrupt = 1.0, .rate_bit_per_s = 1e6},
                        Random(1));
  impairment.push(at(0.0), Bytes{});
  EXPECT_EQ(drain(impairment, 10.0), (Values{-1, -1}));
}

TEST(Impairment, CountsWhatDoesNotFitIntoItsSlots) {
  Impairment impairment({.delay_s = 100.0}, Random(1));
  for (int i = 0; i < 16384 + 10; ++i) impairment.push(at(0.0), bytes_of(i % 100));
  EXPECT_EQ(impairment.counts().queue_dropped, 10U);
  EXPECT_EQ(drain(impairment, 100.0).size(), 16384U);
  impairment.push(at(200.0), bytes_of(5));
  EXPECT_EQ(drain(impairment, 300.0), Values{5});
}

TEST(Impairment, ReorderedDatagramTakesHalfOfTheDelay) {
  Impairment impairment({.delay_s = 1.0, .reorder = 1.0}, Random(1));
  impairment.push(at(0.0), bytes_of(1));
  EXPECT_EQ(drain(impairment, 0.4999), Values{});
  EXPECT_EQ(drain(impairment, 0.5), Values{1});
  EXPECT_EQ(impairment.counts().reordered, 1U);
}

TEST(Impairment, CorruptionFlipsExactlyOneBit) {
  Impairment impairment({.corrupt = 1.0}, Random(1));
  std::vector<int> flips(8 * 20);
  for (int i = 0; i < 5000; ++i) {
    const Bytes in = bytes_of(i % 256, 20);
    impairment.push(at(0.0), in);
    const auto out = impairment.pop(at(0.0)).value();
    int changed = 0;
    for (std::size_t k = 0; k < in.size(); ++k) {
      const auto difference = std::to_integer<unsigned>(in[k] ^ out[k]);
      changed += std::popcount(difference);
      if (difference != 0) ++flips[8 * k + static_cast<std::size_t>(std::countr_zero(difference))];
    }
    ASSERT_EQ(changed, 1);
  }
  EXPECT_GT(*std::min_element(flips.begin(), flips.end()), 0) << "some bit was never hit";
  EXPECT_EQ(impairment.counts().corrupted, 5000U);
}

TEST(Impairment, StepAddsToTheDelayWhileItLasts) {
  Impairment impairment({.delay_s = 0.5, .step_delay_s = 2.0, .step_start_s = 10.0, .step_duration_s = 5.0},
                        Random(1));
  impairment.configure(impairment.config(), at(100.0));  // the clock of the step starts here
  const auto delay_at = [&](double s) {
    impairment.push(at(s), bytes_of(1));
    for (const double d : {0.5, 2.5}) {
      if (!drain(impairment, s + d).empty()) return d;
    }
    return -1.0;
  };
  EXPECT_EQ(delay_at(100.0), 0.5);
  EXPECT_EQ(delay_at(109.99), 0.5);
  EXPECT_EQ(delay_at(110.0), 2.5);
  EXPECT_EQ(delay_at(114.99), 2.5);
  EXPECT_EQ(delay_at(115.0), 0.5);
}

TEST(Impairment, DriftChangesTheDelayWithTimeAndNeverBelowZero) {
  Impairment impairment({.delay_s = 0.05, .drift_s_per_s = -1e-3}, Random(1));
  impairment.configure(impairment.config(), at(0.0));
  impairment.push(at(20.0), bytes_of(1));
  EXPECT_EQ(drain(impairment, 20.03 - 1e-6), Values{});
  EXPECT_EQ(drain(impairment, 20.03 + 1e-6), Values{1});
  impairment.push(at(1000.0), bytes_of(2));
  EXPECT_EQ(drain(impairment, 1000.0), Values{2});
}

TEST(Impairment, BlackoutSwallowsWhatIsSentInItsWindows) {
  Impairment impairment({.blackout_start_s = 10.0, .blackout_duration_s = 3.0, .blackout_period_s = 20.0},
                        Random(1));
  impairment.configure(impairment.config(), at(1000.0));
  for (int s = 0; s < 60; ++s) {
    impairment.push(at(1000.0 + s), bytes_of(s));
    const bool dark = s >= 10 && (s - 10) % 20 < 3;
    EXPECT_EQ(drain(impairment, 1000.0 + s).empty(), dark) << s;
  }
  EXPECT_EQ(impairment.counts().blacked_out, 9U);
}

TEST(Impairment, BlackoutWithoutAPeriodHappensOnce) {
  Impairment impairment({.blackout_start_s = 0.0, .blackout_duration_s = 1.0}, Random(1));
  (void)impairment.pop(at(5.0));  // the clock starts with the first call
  impairment.push(at(5.5), bytes_of(1));
  EXPECT_EQ(drain(impairment, 5.5), Values{});
  impairment.push(at(6.0), bytes_of(2));
  impairment.push(at(1e6), bytes_of(3));
  EXPECT_EQ(drain(impairment, 1e6), (Values{2, 3}));
}

TEST(Impairment, ConfigureLeavesWhatIsUnderWayUntouched) {
  Impairment impairment({.delay_s = 2.0}, Random(1));
  impairment.push(at(0.0), bytes_of(1));
  impairment.configure({.delay_s = 0.1, .loss = 1.0}, at(1.0));
  impairment.push(at(1.0), bytes_of(2));
  impairment.configure({.delay_s = 0.1}, at(1.2));
  impairment.push(at(1.2), bytes_of(3));
  EXPECT_EQ(drain(impairment, 1.9), Values{3});
  EXPECT_EQ(drain(impairment, 1.999999), Values{});
  EXPECT_EQ(drain(impairment, 2.0), Values{1});
}

TEST(Impairment, RateLimitDropsWhatWouldWaitTooLong) {
  // 100 + 28 bytes at 10240 bit/s: 0.1 s each; with 0.2 s of queue the fourth of a burst would wait 0.3 s.
  Impairment impairment({.rate_bit_per_s = 10240.0, .queue_s = 0.2}, Random(1));
  for (int i = 0; i < 5; ++i) impairment.push(at(0.0), bytes_of(i, 100));
  EXPECT_EQ(impairment.counts().queue_dropped, 2U);
  EXPECT_EQ(drain(impairment, 0.0999), Values{});
  EXPECT_EQ(drain(impairment, 0.1), Values{0});
  EXPECT_EQ(drain(impairment, 0.3), (Values{1, 2}));
}

TEST(Impairment, ChargesTheRateLimitForTheTrueSize) {
  Impairment impairment({.rate_bit_per_s = 8.0 * 65535.0, .queue_s = 10.0}, Random(1));
  impairment.push(at(0.0), bytes_of(1, 65507));
  EXPECT_EQ(drain(impairment, 0.999), Values{});
  EXPECT_EQ(drain(impairment, 1.0), Values{1});
}

TEST(Impairment, AVanishingRateDoesNotOutliveItsProfile) {
  Impairment impairment({.rate_bit_per_s = 1e-300}, Random(1));
  impairment.push(at(0.0), bytes_of(1));
  impairment.configure({.rate_bit_per_s = 1e6}, at(1.0));
  impairment.push(at(1.0), bytes_of(2));
  EXPECT_EQ(drain(impairment, 2.0), Values{2});
}

TEST(Impairment, WhatJitterLeavesWithoutDelayKeepsTheOrderOfArrival) {
  Impairment impairment({.jitter_s = 0.1}, Random(1));
  for (int i = 0; i < 200; ++i) impairment.push(at(1.0), bytes_of(i));
  const Values out = drain(impairment, 1.0);
  EXPECT_GT(out.size(), 50U);
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
}

TEST(Impairment, TheFirstDatagramOfAProfileIsLostAsOftenAsAnyOther) {
  const ImpairmentConfig bursts{.loss = 0.3, .loss_burst = 20.0};
  Impairment impairment(bursts, Random(1));
  for (int i = 0; i < 5000; ++i) {
    impairment.configure(bursts, at(i));
    impairment.push(at(i), bytes_of(1));
  }
  EXPECT_NEAR(static_cast<double>(impairment.counts().lost), 1500.0, 5.0 * std::sqrt(5000 * 0.21));
}

TEST(Impairment, SurvivesConfigurationsThatAreNoNumbers) {
  for (const double x :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    Impairment impairment({x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x}, Random(1));
    for (int i = 0; i < 10; ++i) impairment.push(at(i), bytes_of(i));
    (void)drain(impairment, 1e9);
    const auto& c = impairment.counts();
    EXPECT_EQ(c.in, 10U);
    EXPECT_LE(c.out, 20U);
  }
}

}  // namespace
}  // namespace longreach::impairment_test
