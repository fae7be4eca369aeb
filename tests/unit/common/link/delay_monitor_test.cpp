// Against links whose figures are known because the test makes them.

#include "common/link/delay_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::delay_monitor_test {
namespace {

Time at(double s) { return Time{from_seconds(s)}; }
PeerTime peer(double s) { return PeerTime{from_seconds(s + 9e6)}; }

struct Stream {
  DatagramType type = DatagramType::kMotionCommand;
  double rate_hz = 200.0;
  std::uint64_t first_sequence = 1;
  std::size_t bytes = 100;
};

/// Figures at each 50 ms of a link with the given one-way delay of each datagram (negative: lost).
std::vector<LinkFigures> figures(const std::vector<Stream>& streams, double duration_s,
                                 const std::function<double(double sent_s)>& delay_s) {
  struct Flight {
    double received_s, sent_s;
    Header header;
    std::size_t bytes;
  };
  std::vector<Flight> flights;
  for (const Stream& s : streams) {
    for (std::uint64_t i = 0; static_cast<double>(i) < duration_s * s.rate_hz; ++i) {
      const double sent_s = static_cast<double>(i) / s.rate_hz;
      const double d = delay_s(sent_s);
      if (d >= 0.0) flights.push_back({sent_s + d, sent_s, {s.type, 1, s.first_sequence + i}, s.bytes});
    }
  }
  std::stable_sort(flights.begin(), flights.end(),
                   [](const Flight& a, const Flight& b) { return a.received_s < b.received_s; });
  DelayMonitor monitor;
  std::vector<LinkFigures> result;
  std::size_t next = 0;
  for (int k = 0; 0.05 * k < duration_s; ++k) {
    for (; next < flights.size() && flights[next].received_s <= 0.05 * k; ++next) {
      const Flight& f = flights[next];
      monitor.on_datagram(at(f.received_s), f.header, peer(f.sent_s),
                          from_seconds(2.0 * (f.received_s - f.sent_s)), f.bytes);
    }
    result.push_back(monitor.figures(at(0.05 * k)));
  }
  return result;
}

const LinkFigures& figures_at(const std::vector<LinkFigures>& all, double s) {
  return all[static_cast<std::size_t>(std::lround(s / 0.05))];
}

TEST(DelayMonitor, KnowsNothingBeforeTheFirstDatagram) {
  DelayMonitor monitor;
  const LinkFigures f = monitor.figures(at(5.0));
  EXPECT_FALSE(f.rtt_s);
  EXPECT_EQ(f.silence_s, std::numeric_limits<double>::infinity());
  EXPECT_EQ(f.rate_hz, 0.0);
  EXPECT_FALSE(monitor.last_heard());
}

TEST(DelayMonitor, IgnoresDatagramsOvertakenByHalfASecond) {
  DelayMonitor monitor;
  const auto comes = [&monitor](double s, std::uint64_t sequence) {
    monitor.on_datagram(at(s), {DatagramType::kMotionCommand, 1, sequence},
                        peer(0.01 * static_cast<double>(sequence)), kNoRtt, 100);
  };
  comes(1.0, 500);
  for (std::uint64_t old = 1; old < 450; ++old) comes(1.0 + 0.01 * static_cast<double>(old), old);
  EXPECT_EQ(monitor.last_heard(), at(1.0));
  EXPECT_NEAR(monitor.figures(at(5.0)).silence_s, 4.0, 1e-9);
  comes(5.8, 451);  // by jitter
  EXPECT_EQ(monitor.last_heard(), at(5.8));
  comes(6.0, 501);
  EXPECT_EQ(monitor.last_heard(), at(6.0));
}

TEST(DelayMonitor, ConstantDelayIsMeasuredWithinAMillisecond) {
  const auto all = figures({{}}, 10.0, [](double) { return 1.3; });
  for (double s = 1.5; s < 10.0; s += 0.05) {
    const LinkFigures& f = figures_at(all, s);
    ASSERT_NEAR(f.rtt_s.value(), 2.6, 1e-3);
    ASSERT_NEAR(f.rtt_min_s, 2.6, 1e-3);
    ASSERT_LT(f.jitter_s, 1e-6);
    ASSERT_EQ(f.loss, 0.0);
    ASSERT_EQ(f.reorder, 0.0);
  }
}

TEST(DelayMonitor, RoundTripIsTheMedianAndTheLeastOfTheWindow) {
  DelayMonitor monitor;
  const double rtts[] = {5.0, 1.0, 9.0, 2.0, 3.0};
  for (std::uint64_t i = 0; i < 5; ++i) {
    monitor.on_datagram(at(1.0), {DatagramType::kTelemetry, 1, i + 1}, peer(0.5), from_seconds(rtts[i]), 50);
    monitor.on_datagram(at(1.0), {DatagramType::kMotionCommand, 1, i + 1}, peer(0.5), kNoRtt, 50);
  }
  EXPECT_DOUBLE_EQ(monitor.figures(at(1.0)).rtt_s.value(), 3.0);
  EXPECT_DOUBLE_EQ(monitor.figures(at(1.0)).rtt_min_s, 1.0);
  monitor.on_datagram(at(3.5), {DatagramType::kTelemetry, 1, 6}, peer(0.5), from_seconds(4.0), 50);
  EXPECT_DOUBLE_EQ(monitor.figures(at(3.5)).rtt_min_s, 4.0) << "the window has passed";
}

TEST(DelayMonitor, AgeCountsFromWhenThisSideSentTheNewestThatCameBack) {
  DelayMonitor monitor;
  EXPECT_FALSE(monitor.figures(at(1.0)).age_s);
  monitor.on_echo(at(0.4));
  EXPECT_DOUBLE_EQ(monitor.figures(at(1.0)).age_s.value(), 0.6);
  monitor.on_echo(at(0.1));  // overtaken
  EXPECT_DOUBLE_EQ(monitor.figures(at(60.0)).age_s.value(), 59.6) << "it grows in silence";
  monitor.clear();
  EXPECT_FALSE(monitor.figures(at(60.0)).age_s);
}

TEST(DelayMonitor, JitterIsTheDeviationOfTheOneWayTime) {
  for (const double sd_s : {0.002, 0.1}) {
    Random random(1);
    const auto all = figures({{}}, 60.0, [&](double) { return 1.0 + sd_s * random.normal(); });
    for (double s = 4.0; s < 60.0; s += 0.5)
      ASSERT_NEAR(figures_at(all, s).jitter_s, sd_s, sd_s * 5.0 / std::sqrt(800.0));
  }
}

TEST(DelayMonitor, LossIsThatOfTheLink) {
  Random random(2);
  const auto all = figures({{}, {DatagramType::kTelemetry, 30.0}}, 60.0,
                           [&](double) { return random.chance(0.05) ? -1.0 : 0.3; });
  double sum = 0.0;
  int n = 0;
  for (double s = 4.0; s < 60.0; s += 2.0, ++n) {
    const double loss = figures_at(all, s).loss;
    ASSERT_NEAR(loss, 0.05, 5.0 * std::sqrt(0.05 * 0.95 / 460.0));
    sum += loss;
  }
  EXPECT_NEAR(sum / n, 0.05, 5.0 * std::sqrt(0.05 * 0.95 / (460.0 * n)));
}

TEST(DelayMonitor, OvertakenDatagramsAreNotLost) {
  for (const double sd_s : {0.01, 0.1}) {
    Random random(3);
    const auto all = figures({{}}, 30.0, [&](double) { return std::max(0.0, 1.0 + sd_s * random.normal()); });
    for (double s = 5.0; s < 30.0; s += 0.05) {
      ASSERT_LT(figures_at(all, s).loss, 0.005) << "jitter " << sd_s << " at " << s;
      ASSERT_GT(figures_at(all, s).reorder, 0.1);
    }
  }
}

TEST(DelayMonitor, LossIsSeenThroughJitter) {
  Random random(4);
  const auto all = figures({{}}, 60.0, [&](double) {
    return random.chance(0.1) ? -1.0 : std::max(0.0, 1.0 + 0.1 * random.normal());
  });
  for (double s = 5.0; s < 60.0; s += 2.0)
    ASSERT_NEAR(figures_at(all, s).loss, 0.1, 5.0 * std::sqrt(0.09 / 400.0));
}

TEST(DelayMonitor, WithoutReorderingLossShowsAtOnce) {
  // From 10 s on every second datagram is lost: one window later the figure is 50 %, half a window later 25
  // %.
  const auto all = figures({{}}, 20.0, [](double sent_s) {
    return sent_s >= 10.0 && std::lround(sent_s * 200.0) % 2 == 1 ? -1.0 : 0.2;
  });
  EXPECT_EQ(figures_at(all, 10.2).loss, 0.0);
  EXPECT_NEAR(figures_at(all, 11.2).loss, 0.25, 0.01);
  EXPECT_NEAR(figures_at(all, 12.2).loss, 0.5, 0.01);
  EXPECT_NEAR(figures_at(all, 19.0).loss, 0.5, 0.01);
}

TEST(DelayMonitor, ABlackoutCountsForTheWindowThatItFilled) {
  const auto all =
      figures({{}}, 60.0, [](double sent_s) { return sent_s >= 10.0 && sent_s < 40.0 ? -1.0 : 0.2; });
  EXPECT_NEAR(figures_at(all, 30.0).silence_s, 19.805, 1e-6);
  EXPECT_EQ(figures_at(all, 30.0).rate_hz, 0.0);
  EXPECT_NEAR(figures_at(all, 41.2).loss, 0.5, 0.01);
  EXPECT_EQ(figures_at(all, 43.2).loss, 0.0);
}

TEST(DelayMonitor, WhatWasSentBeforeTheFirstDatagramIsNotLost) {
  const auto all = figures({{.first_sequence = 100000}, {DatagramType::kTelemetry, 30.0, 777}}, 5.0,
                           [](double) { return 0.1; });
  for (const LinkFigures& f : all) ASSERT_EQ(f.loss, 0.0);
}

TEST(DelayMonitor, EachTypeHasItsOwnNumbers) {
  const auto all =
      figures({{DatagramType::kStiffnessReport, 10.0, 5}, {DatagramType::kTelemetry, 60.0, 90000}}, 10.0,
              [](double) { return 0.1; });
  EXPECT_EQ(figures_at(all, 9.0).loss, 0.0);
  EXPECT_EQ(figures_at(all, 9.0).reorder, 0.0);
  EXPECT_NEAR(figures_at(all, 9.0).rate_hz, 70.0, 1.0);
}

TEST(DelayMonitor, RateAndBytesAreASecondAlsoAtTheStart) {
  const auto all = figures({{.rate_hz = 1000.0, .bytes = 80}}, 10.0, [](double) { return 0.0; });
  for (const double s : {0.5, 1.0, 5.0}) {
    EXPECT_NEAR(figures_at(all, s).rate_hz, 1000.0, 5.0) << s;
    EXPECT_NEAR(figures_at(all, s).bytes_per_s, 80000.0, 400.0) << s;
  }
}

TEST(DelayMonitor, RateHoldsWhenMoreComesThanItCanKeep) {
  DelayMonitor monitor;
  std::uint64_t sequence = 0;
  for (int i = 0; i < 60000; ++i) {
    monitor.on_datagram(at(5e-5 * i), {DatagramType::kMotionCommand, 1, ++sequence}, peer(5e-5 * i), kNoRtt,
                        100);
  }
  EXPECT_NEAR(monitor.figures(at(3.0)).rate_hz, 20000.0, 50.0);
  EXPECT_EQ(monitor.figures(at(3.0)).loss, 0.0);
}

TEST(DelayMonitor, ClearForgetsEverything) {
  DelayMonitor monitor;
  monitor.on_datagram(at(1.0), {DatagramType::kTelemetry, 1, 1000}, peer(0.5), from_seconds(1.0), 50);
  monitor.clear();
  EXPECT_FALSE(monitor.last_heard());
  EXPECT_FALSE(monitor.figures(at(1.0)).rtt_s);
  monitor.on_datagram(at(2.0), {DatagramType::kTelemetry, 2, 1}, peer(0.5), kNoRtt, 50);
  EXPECT_EQ(monitor.figures(at(2.0)).reorder, 0.0);
  EXPECT_EQ(monitor.figures(at(2.0)).loss, 0.0);
}

TEST(DelayMonitor, ClearForgetsWhatLeftTheWindow) {
  DelayMonitor monitor;
  for (std::uint64_t i = 1; i <= 10; ++i) {
    monitor.on_datagram(at(static_cast<double>(i)), {DatagramType::kTelemetry, 1, i},
                        peer(static_cast<double>(i)), kNoRtt, 50);
  }
  monitor.clear();
  monitor.on_datagram(at(11.0), {DatagramType::kTelemetry, 2, 5000}, peer(11.0), kNoRtt, 50);
  EXPECT_EQ(monitor.figures(at(11.0)).loss, 0.0);
}

TEST(DelayMonitor, HostileTimesAndNumbersGiveFiniteFigures) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  Random random(8);
  DelayMonitor monitor;
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t times[] = {kMost, -kMost - 1, 0, static_cast<std::int64_t>(random.next())};
    const std::uint64_t numbers[] = {std::numeric_limits<std::uint64_t>::max(), 1, random.next(), 0};
    const auto type = static_cast<DatagramType>(1 + random.next() % 4);
    monitor.on_datagram(at(0.01 * i), {type, 1, numbers[random.next() % 4]},
                        PeerTime{Duration{times[random.next() % 4]}}, Duration{times[random.next() % 4]},
                        random.next());
    if (i % 10 != 0) continue;
    const LinkFigures f = monitor.figures(at(0.01 * i));
    ASSERT_TRUE(std::isfinite(f.jitter_s) && std::isfinite(f.rate_hz) && std::isfinite(f.bytes_per_s));
    ASSERT_TRUE(f.loss >= 0.0 && f.loss <= 1.0 && f.reorder >= 0.0 && f.reorder <= 1.0) << f.loss;
  }
}

TEST(DelayMonitor, CountsNoLossForTheStallOfThisSide) {
  DelayMonitor monitor;
  const auto receive = [&](std::uint64_t sequence) {
    const double s = 0.005 * static_cast<double>(sequence);
    monitor.on_datagram(at(s), {DatagramType::kTelemetry, 1, sequence}, peer(s), kNoRtt, 100);
  };
  for (std::uint64_t sequence = 1; sequence <= 400; ++sequence) receive(sequence);
  monitor.skip_stall();  // from 2 to 3 s: 200 datagrams are missed
  for (std::uint64_t sequence = 600; sequence <= 1000; ++sequence) {
    receive(sequence);
    EXPECT_EQ(monitor.figures(at(0.005 * static_cast<double>(sequence))).loss, 0.0) << sequence;
  }
  for (std::uint64_t sequence = 1001; sequence <= 1400; sequence += 2) receive(sequence);
  EXPECT_NEAR(monitor.figures(at(7.0)).loss, 0.5, 0.01) << "later losses count";
}

}  // namespace
}  // namespace longreach::delay_monitor_test
