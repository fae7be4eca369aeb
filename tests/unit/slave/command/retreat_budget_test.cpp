#include "slave/command/retreat_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach::retreat_budget_test {
namespace {

constexpr double kTick_s = 1e-3;

/// At one speed while it may, until the force has come down to 5 N or the way is a metre.
double way_m(RetreatBudget& retreat_budget, const auto& force_n, double speed_m_per_s = 0.1) {
  double way = 0.0;
  while (retreat_budget.may_go_on() && force_n(way) > 5.0 && way < 1.0) {
    retreat_budget.go(speed_m_per_s * kTick_s, force_n(way), kTick_s);
    way += speed_m_per_s * kTick_s;
  }
  return way;
}

TEST(RetreatBudget, EndsAfterTwentyMillimetresWithoutResponse) {
  RetreatBudget retreat_budget;
  EXPECT_NEAR(way_m(retreat_budget, [](double) { return 30.0; }), 0.02, 2.1e-4);
  EXPECT_FALSE(retreat_budget.may_go_on());
}

TEST(RetreatBudget, NoiseIsNotAResponse) {
  RetreatBudget retreat_budget;
  EXPECT_NEAR(way_m(retreat_budget, [](double way) { return way < 1e-3 ? 30.0 : 29.6; }), 0.02, 2.1e-4);
}

TEST(RetreatBudget, ExtendsWhileForceResponds) {
  for (const double stiffness : {50.0, 90.0, 130.0, 1000.0, 1e5}) {
    RetreatBudget retreat_budget;
    const auto force_n = [stiffness](double way) { return 30.0 - stiffness * way; };
    const double way = way_m(retreat_budget, force_n);
    EXPECT_EQ(force_n(way) <= 5.0, stiffness > 100.0) << stiffness;
    EXPECT_LE(way, 0.02 + (30.0 - force_n(way)) / 100.0 + 1e-9) << stiffness;
  }
}

// Of the 150 mm that a fall by 15 N would be good for.
TEST(RetreatBudget, SelfDecayingForceAddsNoDistance) {
  for (const double there_m : {0.0, 0.005, 0.015}) {
    RetreatBudget retreat_budget;
    const auto leaps = [there_m](double way) { return way <= there_m ? 30.0 : 15.0; };
    EXPECT_LT(way_m(retreat_budget, leaps), there_m + 0.011 + 0.02) << "11 mm while it is smoothed";
  }
}

TEST(RetreatBudget, ReducesForceOfTremblingContact) {
  RetreatBudget retreat_budget;
  const auto trembles = [](double way) { return 30.0 - 300.0 * way + 1.5 * std::sin(way / 5e-4); };
  EXPECT_LE(trembles(way_m(retreat_budget, trembles)), 5.0);
}

TEST(RetreatBudget, ReentryRestoresBudgetUpToInitialValue) {
  RetreatBudget retreat_budget;
  retreat_budget.go(0.015, 20.0, kTick_s);
  retreat_budget.go(-0.005, 20.0, kTick_s);
  EXPECT_NEAR(retreat_budget.left_m(), 0.01, 1e-12);
  retreat_budget.go(-0.5, 20.0, kTick_s);
  EXPECT_NEAR(retreat_budget.left_m(), 0.02, 1e-12);
  retreat_budget.go(0.02, 20.0, kTick_s);
  retreat_budget.reset();
  EXPECT_NEAR(retreat_budget.left_m(), 0.02, 1e-12);
}

TEST(RetreatBudget, SteadyForceCountsAsResponseIfItGrewAtRest) {
  constexpr double kSpeed_m_per_s = 0.01;
  for (const double stiffness : {90.0, 110.0}) {
    RetreatBudget retreat_budget;
    double way = 0.0;
    for (; retreat_budget.may_go_on() && way < 0.5; way += kSpeed_m_per_s * kTick_s)
      retreat_budget.go(kSpeed_m_per_s * kTick_s, 20.0, kTick_s, stiffness * kSpeed_m_per_s);
    if (stiffness > 100.0) {
      EXPECT_GE(way, 0.5);
    } else {
      EXPECT_NEAR(way, 0.15, 2e-3) << "20 mm, less the noise of 5 mm, by a tenth";
    }
  }
}

TEST(RetreatBudget, RespondingRetreatIsBounded) {
  RetreatBudget retreat_budget;
  retreat_budget.limit(0.1);
  EXPECT_NEAR(way_m(retreat_budget, [](double way) { return 300.0 - 200.0 * way; }), 0.1, 2.1e-4);
}

}  // namespace
}  // namespace longreach::retreat_budget_test
