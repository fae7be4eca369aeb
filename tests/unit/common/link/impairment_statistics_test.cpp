#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/common/link/impairment_run.hpp"

namespace longreach::impairment_statistics_test {
namespace {

struct Delays {
  double mean_s = 0.0, sd_s = 0.0;
};

Delays delays(const ImpairmentOutcome& outcome) {
  double sum = 0.0, squares = 0.0;
  for (const DatagramArrival& a : outcome.arrivals) {
    const double d = a.received_s - a.sent_s;
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(outcome.arrivals.size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n)};
}

double lost_fraction(const ImpairmentOutcome& outcome, int sent) {
  return 1.0 - static_cast<double>(outcome.copies.size()) / sent;
}

double mean_burst(const ImpairmentOutcome& outcome, int sent) {
  int lost = 0, bursts = 0;
  bool before = false;
  for (int i = 0; i < sent; ++i) {
    const bool gone = !outcome.copies.contains(static_cast<std::uint32_t>(i));
    lost += gone ? 1 : 0;
    bursts += gone && !before ? 1 : 0;
    before = gone;
  }
  return static_cast<double>(lost) / std::max(1, bursts);
}

TEST(ImpairmentStatistics, JitterHasTheAskedMeanAndDeviation) {
  const auto outcome = run({.config = {.delay_s = 0.3, .jitter_s = 0.03}});
  const Delays d = delays(outcome);
  // Seen on ticks of 1 ms: half a tick later on average.
  EXPECT_NEAR(d.mean_s, 0.3005, 5.0 * 0.03 / std::sqrt(20000.0));
  EXPECT_NEAR(d.sd_s, 0.03, 0.03 * 5.0 / std::sqrt(40000.0));
}

TEST(ImpairmentStatistics, JitterIsIndependentAndReorders) {
  const auto outcome = run({.config = {.delay_s = 0.3, .jitter_s = 0.03}});
  int inversions = 0;
  for (std::size_t i = 1; i < outcome.arrivals.size(); ++i) {
    inversions += outcome.arrivals[i].number < outcome.arrivals[i - 1].number ? 1 : 0;
  }
  EXPECT_GT(inversions, 2000);
}

TEST(ImpairmentStatistics, JitterNeverMakesADelayNegative) {
  const auto outcome = run({.config = {.delay_s = 0.0, .jitter_s = 0.03}});
  int at_once = 0;
  for (const DatagramArrival& a : outcome.arrivals) {
    ASSERT_GE(a.received_s, a.sent_s - 1e-9);
    at_once += a.received_s - a.sent_s < 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(at_once, 10000, 5.0 * std::sqrt(5000.0));  // the half that would be below zero
}

TEST(ImpairmentStatistics, IndependentLossHasItsRateAndItsShortBursts) {
  constexpr int kSent = 100000;
  const auto outcome = run({.config = {.loss = 0.1}, .datagrams = kSent, .period_s = 0.001});
  EXPECT_NEAR(lost_fraction(outcome, kSent), 0.1, 5.0 * std::sqrt(0.09 / kSent));
  EXPECT_NEAR(mean_burst(outcome, kSent), 1.0 / 0.9, 0.03);
  EXPECT_EQ(outcome.counts.lost + outcome.counts.out, outcome.counts.in);
}

TEST(ImpairmentStatistics, BurstLossHasItsRateAndItsBurstLength) {
  constexpr int kSent = 200000;
  struct Case {
    double loss, burst;
  };
  for (const Case c : {Case{0.02, 4.0}, Case{0.1, 10.0}, Case{0.3, 1.5}, Case{0.5, 3.0}}) {
    const auto outcome =
        run({.config = {.loss = c.loss, .loss_burst = c.burst}, .datagrams = kSent, .period_s = 0.001});
    // A chain that forgets in about `burst` steps has 2 burst - 1 times the variance of independent losses.
    const double sd = std::sqrt(c.loss * (1.0 - c.loss) * (2.0 * c.burst - 1.0) / kSent);
    EXPECT_NEAR(lost_fraction(outcome, kSent), c.loss, 5.0 * sd) << c.loss << ' ' << c.burst;
    const double bursts = kSent * c.loss / c.burst;
    EXPECT_NEAR(mean_burst(outcome, kSent), c.burst, 5.0 * c.burst / std::sqrt(bursts))
        << c.loss << ' ' << c.burst;
  }
}

TEST(ImpairmentStatistics, MeanLossHoldsWhereTheBurstsWouldBeTooShortForIt) {
  constexpr int kSent = 100000;
  const auto most = run({.config = {.loss = 0.9, .loss_burst = 2.0}, .datagrams = kSent, .period_s = 0.001});
  EXPECT_NEAR(lost_fraction(most, kSent), 0.9, 0.01);
  const auto all = run({.config = {.loss = 1.0, .loss_burst = 4.0}, .datagrams = 1000});
  EXPECT_TRUE(all.arrivals.empty());
}

TEST(ImpairmentStatistics, DuplicatesTheAskedFraction) {
  const auto outcome = run({.config = {.delay_s = 0.1, .jitter_s = 0.01, .duplicate = 0.2}});
  int twice = 0;
  for (const auto& [number, copies] : outcome.copies) {
    ASSERT_LE(copies, 2);
    twice += copies == 2 ? 1 : 0;
  }
  EXPECT_EQ(outcome.copies.size(), 20000U);
  EXPECT_NEAR(twice, 4000, 5.0 * std::sqrt(20000 * 0.2 * 0.8));
  EXPECT_EQ(outcome.counts.duplicated, static_cast<std::uint64_t>(twice));
}

TEST(ImpairmentStatistics, ReordersTheAskedFraction) {
  const auto outcome = run({.config = {.delay_s = 0.4, .reorder = 0.05}});
  int early = 0;
  for (const DatagramArrival& a : outcome.arrivals) early += a.received_s - a.sent_s < 0.3 ? 1 : 0;
  EXPECT_NEAR(early, 1000, 5.0 * std::sqrt(20000 * 0.05 * 0.95));
}

TEST(ImpairmentStatistics, RateLimitPassesItsThroughputAndNoMore) {
  // Offered: 200 a second of 128 bytes with headers, 204.8 kbit/s; passed: 64 kbit/s, 62.5 a second.
  const auto outcome = run({.config = {.rate_bit_per_s = 64000.0, .queue_s = 0.2}, .datagrams = 4000});
  EXPECT_NEAR(static_cast<double>(outcome.arrivals.size()), 62.5 * 20.2, 3.0);
  for (const DatagramArrival& a : outcome.arrivals)
    ASSERT_LE(a.received_s - a.sent_s, 0.2 + 0.016 + 0.001 + 1e-9);
}

TEST(ImpairmentStatistics, RateLimitAboveTheLoadLosesNothing) {
  const auto outcome = run({.config = {.rate_bit_per_s = 256000.0}, .datagrams = 4000});
  EXPECT_EQ(outcome.arrivals.size(), 4000U);
  EXPECT_EQ(outcome.counts.queue_dropped, 0U);
}

const ImpairmentConfig kEverything{.delay_s = 0.4,
                                   .jitter_s = 0.02,
                                   .loss = 0.05,
                                   .loss_burst = 3.0,
                                   .duplicate = 0.05,
                                   .reorder = 0.05,
                                   .corrupt = 0.0,
                                   .rate_bit_per_s = 300000.0};

TEST(ImpairmentStatistics, EqualSeedsGiveEqualRunsAndOthersDoNot) {
  const auto a = run({.config = kEverything, .seed = 5, .datagrams = 2000});
  const auto b = run({.config = kEverything, .seed = 5, .datagrams = 2000});
  const auto c = run({.config = kEverything, .seed = 6, .datagrams = 2000});
  ASSERT_EQ(a.arrivals.size(), b.arrivals.size());
  for (std::size_t i = 0; i < a.arrivals.size(); ++i) {
    ASSERT_EQ(a.arrivals[i].number, b.arrivals[i].number);
    ASSERT_EQ(a.arrivals[i].received_s, b.arrivals[i].received_s);
  }
  EXPECT_NE(a.copies, c.copies);
}

TEST(ImpairmentStatistics, SwitchingOneEffectOnDoesNotChangeWhatAnotherDraws) {
  // Jitter alone, against jitter with loss, duplicates and blackout: whatever still comes as an original
  // takes the same time; and the same datagrams are lost with jitter as without.
  const ImpairmentRun jitter{.config = {.delay_s = 0.4, .jitter_s = 0.02}, .datagrams = 4000};
  ImpairmentRun more = jitter;
  more.config.loss = 0.2;
  more.config.blackout_start_s = 5.0;
  more.config.blackout_duration_s = 2.0;
  std::map<std::uint32_t, double> plain;
  for (const DatagramArrival& a : run(jitter).arrivals) plain[a.number] = a.received_s;
  const auto lossy = run(more);
  ASSERT_GT(lossy.arrivals.size(), 2000U);
  for (const DatagramArrival& a : lossy.arrivals) ASSERT_EQ(a.received_s, plain[a.number]);

  more.config.duplicate = 0.3;
  std::map<std::uint32_t, int> same_time;
  for (const DatagramArrival& a : run(more).arrivals)
    same_time[a.number] += a.received_s == plain[a.number] ? 1 : 0;
  ASSERT_EQ(same_time.size(), lossy.copies.size()) << "duplication changed the losses";
  for (const auto& [number, hits] : same_time) ASSERT_GE(hits, 1) << number;

  const ImpairmentRun loss{.config = {.loss = 0.2, .blackout_start_s = 5.0, .blackout_duration_s = 2.0},
                           .datagrams = 4000};
  EXPECT_EQ(run(loss).copies, lossy.copies);
}

}  // namespace
}  // namespace longreach::impairment_statistics_test
