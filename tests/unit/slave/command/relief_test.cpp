#include "slave/command/relief.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach {
namespace {

constexpr double kTick_s = 1e-3;

/// At one speed while it may, until the force has come down to 5 N or the way is a metre.
double way_m(Relief& relief, const auto& force_n, double speed_m_per_s = 0.1) {
  double way = 0.0;
  while (relief.may_go_on() && force_n(way) > 5.0 && way < 1.0) {
    relief.go(speed_m_per_s * kTick_s, force_n(way), kTick_s);
    way += speed_m_per_s * kTick_s;
  }
  return way;
}

TEST(Relief, WithoutAnswerItEndsAfterTwentyMillimetres) {
  Relief relief;
  EXPECT_NEAR(way_m(relief, [](double) { return 30.0; }), 0.02, 2.1e-4);
  EXPECT_FALSE(relief.may_go_on());
}

TEST(Relief, NoiseIsNoAnswer) {
  Relief relief;
  EXPECT_NEAR(way_m(relief, [](double way) { return way < 1e-3 ? 30.0 : 29.6; }), 0.02, 2.1e-4);
}

TEST(Relief, GoesAsFarAsTheForceAnswers) {
  for (const double stiffness : {50.0, 90.0, 130.0, 1000.0, 1e5}) {
    Relief relief;
    const auto force_n = [stiffness](double way) { return 30.0 - stiffness * way; };
    const double way = way_m(relief, force_n);
    EXPECT_EQ(force_n(way) <= 5.0, stiffness > 100.0) << stiffness;
    EXPECT_LE(way, 0.02 + (30.0 - force_n(way)) / 100.0 + 1e-9) << stiffness;
  }
}

// Of the 150 mm that a fall by 15 N would be good for.
TEST(Relief, AForceThatEasesByItselfBuysNoMoreWayThanThereWasAtFirst) {
  for (const double there_m : {0.0, 0.005, 0.015}) {
    Relief relief;
    const auto leaps = [there_m](double way) { return way <= there_m ? 30.0 : 15.0; };
    EXPECT_LT(way_m(relief, leaps), there_m + 0.011 + 0.02) << "11 mm while it is smoothed";
  }
}

TEST(Relief, AContactThatTremblesIsRelieved) {
  Relief relief;
  const auto trembles = [](double way) { return 30.0 - 300.0 * way + 1.5 * std::sin(way / 5e-4); };
  EXPECT_LE(trembles(way_m(relief, trembles)), 5.0);
}

TEST(Relief, AWayBackInIsWayThatIsLeftAgainButNeverMoreThanAtFirst) {
  Relief relief;
  relief.go(0.015, 20.0, kTick_s);
  relief.go(-0.005, 20.0, kTick_s);
  EXPECT_NEAR(relief.left_m(), 0.01, 1e-12);
  relief.go(-0.5, 20.0, kTick_s);
  EXPECT_NEAR(relief.left_m(), 0.02, 1e-12);
  relief.go(0.02, 20.0, kTick_s);
  relief.reset();
  EXPECT_NEAR(relief.left_m(), 0.02, 1e-12);
}

TEST(Relief, AForceThatWouldGrowAtRestAnswersByNotGrowing) {
  constexpr double kSpeed_m_per_s = 0.01;
  for (const double stiffness : {90.0, 110.0}) {
    Relief relief;
    double way = 0.0;
    for (; relief.may_go_on() && way < 0.5; way += kSpeed_m_per_s * kTick_s)
      relief.go(kSpeed_m_per_s * kTick_s, 20.0, kTick_s, stiffness * kSpeed_m_per_s);
    if (stiffness > 100.0) {
      EXPECT_GE(way, 0.5);
    } else {
      EXPECT_NEAR(way, 0.15, 2e-3) << "20 mm, less the noise of 5 mm, by a tenth";
    }
  }
}

TEST(Relief, AnAnsweredWayIsNoLongerThanItMayBe) {
  Relief relief;
  relief.limit(0.1);
  EXPECT_NEAR(way_m(relief, [](double way) { return 300.0 - 200.0 * way; }), 0.1, 2.1e-4);
}

}  // namespace
}  // namespace longreach
