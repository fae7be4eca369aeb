// What the playout promises goal by goal. Behaviour over links: playout_link_test.cpp.

#include "common/link/playout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace longreach::playout_test {
namespace {

Time at(double s) { return Time{from_seconds(s)}; }
PeerTime peer(double s) { return PeerTime{from_seconds(s - 5e5)}; }

Vector3 goal(double x) { return {x, 0.0, -x}; }

constexpr PlayoutConfig kFixed0{.adaptive = false, .fixed_delay_s = 0.0};
constexpr PlayoutConfig kFixed100{.adaptive = false, .fixed_delay_s = 0.1};

TEST(Playout, SaysNothingBeforeTheFirstGoal) {
  Playout playout;
  EXPECT_FALSE(playout.play(at(1.0)));
  playout.push(at(1.0), peer(0.0), 1, goal(1.0));
  EXPECT_TRUE(playout.play(at(1.0)));
  playout.clear();
  EXPECT_FALSE(playout.play(at(1.0)));
}

TEST(Playout, PlaysAGoalInTheTickItArrivesWithoutDelayAndJitter) {
  for (const PlayoutConfig& config : {kFixed0, PlayoutConfig{}}) {
    Playout playout(config);
    for (int i = 1; i <= 3000; ++i) {
      playout.push(at(0.005 * i + 1.3), peer(0.005 * i), static_cast<std::uint64_t>(i), goal(i));
      const auto played = playout.play(at(0.005 * i + 1.3));
      ASSERT_EQ(played->sequence, i);
      ASSERT_EQ(played->goal, goal(i));
      ASSERT_EQ(playout.delay_s(), 0.0);
    }
  }
}

TEST(Playout, InterpolatesBetweenTheTwoGoalsAroundThePlayoutTime) {
  Playout playout(kFixed100);
  playout.push(at(1.0), peer(0.0), 10, goal(1.0));
  playout.push(at(1.04), peer(0.04), 12, goal(3.0));
  const auto at_first = playout.play(at(1.1));
  EXPECT_DOUBLE_EQ(at_first->sequence, 10.0);
  const auto between = playout.play(at(1.11));
  EXPECT_NEAR(between->sequence, 10.5, 1e-9);
  EXPECT_NEAR(between->goal.x(), 1.5, 1e-9);
  EXPECT_NEAR(between->goal.z(), -1.5, 1e-9);
}

TEST(Playout, HoldsLastGoalOnSilence) {
  Playout playout(kFixed100);
  playout.push(at(1.0), peer(0.0), 1, goal(1.0));
  playout.push(at(1.01), peer(0.01), 2, goal(2.0));
  for (const double now_s : {1.11, 2.0, 1e3, 1e9}) {
    EXPECT_EQ(playout.play(at(now_s))->sequence, 2.0);
    EXPECT_EQ(playout.play(at(now_s))->goal, goal(2.0));
  }
}

TEST(Playout, LateGoalsFillThePastInOrder) {
  Playout playout(kFixed100);
  playout.push(at(1.00), peer(0.00), 1, goal(0.0));
  playout.push(at(1.04), peer(0.04), 5, goal(4.0));
  playout.push(at(1.05), peer(0.02), 3, goal(-7.0));
  EXPECT_NEAR(playout.play(at(1.12))->goal.x(), -7.0, 1e-9);
  EXPECT_NEAR(playout.play(at(1.13))->sequence, 4.0, 1e-9);
  EXPECT_NEAR(playout.play(at(1.13))->goal.x(), -1.5, 1e-9);
}

TEST(Playout, OlderGoalsNeverMoveThePlayedSequenceBack) {
  Playout playout(kFixed0);
  playout.push(at(1.0), peer(0.0), 5, goal(5.0));
  EXPECT_EQ(playout.play(at(1.0))->sequence, 5.0);
  for (std::uint64_t sequence = 1; sequence < 5; ++sequence) {
    playout.push(at(1.01), peer(-0.005), sequence, goal(0.0));
    EXPECT_EQ(playout.play(at(1.01))->goal, goal(5.0));
  }
}

TEST(Playout, DuplicatesChangeNothing) {
  Playout playout(kFixed0);
  playout.push(at(1.0), peer(0.0), 1, goal(1.0));
  playout.push(at(0.2), peer(0.0), 1, goal(99.0));  // would shorten the transit, too
  EXPECT_EQ(playout.play(at(1.0))->goal, goal(1.0));
  EXPECT_EQ(playout.delay_s(), 0.0);
}

TEST(Playout, KeepsAtLeast8192GoalsAndTheOldestGiveWay) {
  Playout playout(kFixed0);
  for (int i = 1; i <= 20000; ++i) {
    playout.push(at(0.001 * i), peer(0.001 * i), static_cast<std::uint64_t>(i), goal(i));
  }
  const auto found = playout.crossing(Vector3::UnitX(), Vector3(20000 - 8190.5, 0, 0), 20000);
  EXPECT_NEAR(found.value(), 20000 - 8190.5, 1e-6);
  playout.push(at(21.0), peer(0.001), 1, goal(1e6));  // older than all: not kept
  EXPECT_EQ(playout.play(at(21.0))->goal, goal(20000));
}

TEST(Playout, LateGoalsOfAFullStoreStillFillThePast) {
  Playout playout(kFixed100);
  for (int i = 1; i <= 9000; ++i) {
    if (i == 8990) continue;
    playout.push(at(0.01 * i), peer(0.01 * i), static_cast<std::uint64_t>(i), goal(0.0));
  }
  playout.push(at(90.0), peer(89.9), 8990, goal(7.0));
  EXPECT_NEAR(playout.play(at(90.0))->goal.x(), 7.0, 1e-9);
}

TEST(Playout, IgnoresWhatIsNoGoal) {
  Playout playout(kFixed0);
  playout.push(at(1.0), peer(0.0), 0, goal(1.0));
  playout.push(at(1.0), peer(0.0), 1, goal(std::numeric_limits<double>::quiet_NaN()));
  playout.push(at(1.0), peer(0.0), 2, goal(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(playout.play(at(1.0)));
}

TEST(Playout, SurvivesHostileTimesAndNumbers) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t sent_ns : {kMost, -kMost - 1, std::int64_t{0}}) {
    Playout playout;
    for (int i = 1; i <= 100; ++i) {
      playout.push(at(0.01 * i), peer(0.01 * i), static_cast<std::uint64_t>(i), goal(i));
      (void)playout.play(at(0.01 * i));
    }
    playout.push(at(1.01), PeerTime{Duration{sent_ns}}, std::numeric_limits<std::uint64_t>::max(), goal(5.0));
    for (int i = 101; i <= 3000; ++i) {
      playout.push(at(0.01 * i), peer(0.01 * i), static_cast<std::uint64_t>(i), goal(i));
      const auto played = playout.play(at(0.01 * i));
      ASSERT_TRUE(played->goal.allFinite());
      ASSERT_TRUE(std::isfinite(played->sequence));
      ASSERT_TRUE(std::isfinite(playout.delay_s()));
    }
  }
}

TEST(Playout, SurvivesConfigurationsThatAreNoNumbers) {
  for (const double x :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    for (const bool adaptive : {false, true}) {
      Playout playout({.adaptive = adaptive, .fixed_delay_s = x, .quantile = x, .delay_max_s = x});
      for (int i = 1; i <= 500; ++i) {
        playout.push(at(0.01 * i), peer(0.01 * i), static_cast<std::uint64_t>(i), goal(i));
        ASSERT_TRUE(playout.play(at(0.01 * i))->goal.allFinite());
      }
    }
  }
}

// Goals on a straight line from -0.5 m at sequence 1 by 1 m a sequence.
Playout line(double step_m, int count) {
  Playout playout(kFixed0);
  for (int i = 1; i <= count; ++i) {
    playout.push(at(i), peer(i), static_cast<std::uint64_t>(i), goal(-0.5 + step_m * (i - 1)));
  }
  return playout;
}

TEST(PlayoutCrossing, FindsTheFractionalSequenceOfThePlane) {
  const Playout playout = line(1.0, 10);
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3(3.25, 0, 0), 10.0).value(), 4.75, 1e-12);
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3(3.25, 9, 9), 4.8).value(), 4.75, 1e-12);
}

TEST(PlayoutCrossing, DoesNotLookBeyondTheLastSequence) {
  const Playout playout = line(1.0, 10);
  // At 4.6 the goal is 0.15 m before the plane: the nearest that there is.
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3(3.25, 0, 0), 4.6).value(), 4.6, 1e-12);
  EXPECT_FALSE(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 0.5));
  EXPECT_FALSE(playout.crossing(Vector3::UnitX(), Vector3::Zero(), std::nan("")));
  EXPECT_FALSE(Playout().crossing(Vector3::UnitX(), Vector3::Zero(), 5.0));
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3(20, 0, 0), 1e9).value(), 10.0, 1e-12);
}

TEST(PlayoutCrossing, TakesTheNewestOfSeveral) {
  Playout playout(kFixed0);
  const double x[] = {-1.0, 1.0, -1.0, -3.0,
                      1.0,  2.0, -1.0, -2.0};  // inwards at 1.5 and 4.75, outwards at 2.5 and 6.667
  for (int i = 0; i < 8; ++i) playout.push(at(i), peer(i), static_cast<std::uint64_t>(i + 1), goal(x[i]));
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 8.0).value(), 4.75, 1e-12);
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 4.5).value(), 1.5, 1e-12);
  EXPECT_NEAR(playout.crossing(-Vector3::UnitX(), Vector3::Zero(), 8.0).value(), 6.0 + 2.0 / 3.0, 1e-12);
}

TEST(PlayoutCrossing, GivesTheNearestWhereNothingCrosses) {
  Playout playout(kFixed0);
  const double x[] = {-5.0, -3.0, -0.1, -2.0, -0.1, -4.0};
  for (int i = 0; i < 6; ++i) playout.push(at(i), peer(i), static_cast<std::uint64_t>(i + 1), goal(x[i]));
  EXPECT_EQ(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 6.0).value(), 5.0) << "the newest of equals";
  EXPECT_EQ(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 4.0).value(), 3.0);
  EXPECT_EQ(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 6.0, 0.11).value(), 5.0);
  EXPECT_FALSE(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 6.0, 0.09)) << "too far from the plane";
}

// The sender's goals 5 and 6 may be anywhere between their neighbours, so it would find another goal there.
TEST(PlayoutCrossing, IsNotIdentifiableWhereACommandIsMissing) {
  const auto push = [](Playout& playout, int i) {
    playout.push(at(i), peer(i), static_cast<std::uint64_t>(i), goal(0.1 * (i - 5.25) * std::abs(i - 5.25)));
  };
  Playout playout(kFixed0);
  for (const int i : {1, 2, 3, 4, 7, 8}) push(playout, i);
  EXPECT_FALSE(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 8.0));
  push(playout, 6);
  EXPECT_FALSE(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 8.0));
  push(playout, 5);  // late
  EXPECT_NEAR(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 8.0).value(), 5.1, 1e-12);
}

TEST(PlayoutCrossing, AGoalOnThePlaneHasCrossed) {
  Playout playout(kFixed0);
  const double x[] = {-1.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) playout.push(at(i), peer(i), static_cast<std::uint64_t>(i + 1), goal(x[i]));
  EXPECT_EQ(playout.crossing(Vector3::UnitX(), Vector3::Zero(), 3.0).value(), 2.0);
}

}  // namespace
}  // namespace longreach::playout_test
