// Speed against accuracy: what the experiment `trade` rests on, and what the defaults promise there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/tracking.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach::trade_test {
namespace {

TradePoint point(double cost, double error) { return {"a", "", cost, error}; }

TEST(Trade, AFrontIsWhatNothingElseBeats) {
  const std::vector<TradePoint> points{point(1, 5), point(2, 3), point(3, 3),
                                       point(4, 1), point(2, 3), point(5, 2)};
  const std::vector<bool> expected{true, true, false, true, true, false};
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(on_front(points, i), expected[i]) << i;
}

TEST(Trade, InstructionsAreCountedExactly) {
  volatile double sum = 0.0;
  const auto add = [&sum](int times) {
    return [&sum, times](int) {
      for (int i = 0; i < times; ++i) sum = sum + 1.0;
    };
  };
  const double few = instructions(4, add(100));
  const double again = instructions(4, add(100));
  if (std::isnan(few)) {
    EXPECT_TRUE(std::isnan(again));  // the system forbids it
    return;
  }
  EXPECT_EQ(again, few);
  const double more = instructions(4, add(1100)) - few;
  EXPECT_GE(more, 3000.0);  // at least load, add and store in each turn
  EXPECT_LE(more, 20000.0);
  EXPECT_EQ(std::fmod(more, 1000.0), 0.0) << more;
}

/// The default of a stage.
TradePoint standard(const TradeStage& stage) {
  ExperimentRun run;
  for (const TradePoint& p : stage.measure(run))
    if (p.standard) return p;
  ADD_FAILURE() << stage.name << " has no default";
  return {};
}

TEST(Trade, TheDefaultsAreAsAccurateAsADoubleIs) {
  EXPECT_LE(standard(trade_delta_forward()).error, 1e-15 * 4.0);
  EXPECT_LE(standard(trade_arm_inverse()).error, 1e-14);
  EXPECT_LE(standard(trade_contact()).error, 1e-14);
}

TEST(Trade, TheDefaultsAreSmoothAndFeelRight) {
  const Tracking defaults = track({}, {});
  EXPECT_LE(defaults.roughness_m_per_s2, 0.1);
  EXPECT_LE(1e3 * defaults.bent_rms_m, 0.1);          // mm
  EXPECT_LE(standard(trade_estimator()).error, 0.1);  // %
}

/// FAST is right on three walls and wrong on one: a mean would hide that.
TEST(Trade, ThePresetsOfAccuracyAreJudgedByTheirWorstWall) {
  double worst = 0.0, mean = 0.0;
  for (const char* wall : {"500", "1000", "2000", "4000"}) {
    const Touched one =
        touched({}, {"accuracy=FAST", std::string("scene.material.wall.stiffness_n_per_m=") + wall,
                     "scene.material.wall.exponent=1.5"});
    worst = std::max(worst, 100.0 * one.stiffness_error);
    mean += 25.0 * one.stiffness_error;
  }
  ASSERT_GT(worst, 1.5 * mean) << "the control: the mean is another figure";
  int defaults = 0;
  for (const TradePoint& p : trade_accuracy_stiffness().measure({})) {
    if (p.series == "fast") EXPECT_NEAR(p.error, worst, 1e-9);
    if (!p.standard) continue;
    ++defaults;
    EXPECT_LE(p.error, 5.0);  // %: 1.6 with seeds 1 to 4; seeds 5 to 8 reach 2.4
  }
  EXPECT_EQ(defaults, 1);
}

}  // namespace
}  // namespace longreach::trade_test
