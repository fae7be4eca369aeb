#include "slave/estimation/working_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slave/estimation/local_tangent.hpp"

namespace longreach::working_depth_test {
namespace {

constexpr double kDt = 1e-3, kMemory_s = 2.0, kUsual_m = 2e-3;

struct Hand {
  WorkingDepth depth;
  int changes = 0;

  /// About `mean_m` with this amplitude, period 4 s.
  void press(double seconds, double mean_m, double amplitude_m, double exponent) {
    for (double t = 0.0; t < seconds; t += kDt) {
      const double now_m = mean_m + amplitude_m * std::sin(0.5 * std::numbers::pi * t);
      if (depth.follow(kUsual_m, now_m, exponent, kMemory_s, kDt)) ++changes;
    }
  }
};

TEST(WorkingDepth, IsThatOfAUsualForceUntilTheHandWorksElsewhere) {
  Hand hand;
  EXPECT_EQ(hand.depth.depth_m(kUsual_m), kUsual_m);
  hand.press(1.9, 1e-3, 0.0, 1.5);
  EXPECT_EQ(hand.depth.depth_m(kUsual_m), kUsual_m);
  hand.press(0.2, 1e-3, 0.0, 1.5);
  EXPECT_NEAR(hand.depth.depth_m(kUsual_m), 1e-3, 1e-5);
}

TEST(WorkingDepth, OfALinearSpringStays) {
  Hand hand;
  hand.press(20.0, 1e-3, 0.5e-3, 1.0);
  EXPECT_EQ(hand.changes, 0);
}

TEST(WorkingDepth, OfAHandThatSwingsIsTheMeanOfASwing) {
  Hand hand;
  hand.press(12.0, 1e-3, 0.3e-3, 2.0);
  EXPECT_NEAR(hand.depth.depth_m(kUsual_m), 1e-3, 2e-5);
  const int before = hand.changes;
  hand.press(40.0, 1e-3, 0.3e-3, 2.0);
  EXPECT_LE(hand.changes - before, 1);
}

TEST(WorkingDepth, FollowsAHandThatPressesDeeper) {
  Hand hand;
  hand.press(8.0, 1e-3, 0.0, 1.5);
  hand.press(8.0, 3e-3, 0.0, 1.5);
  EXPECT_NEAR(hand.depth.depth_m(kUsual_m), 3e-3, 0.04 * 3e-3);  // 2 % of the tangent
}

TEST(WorkingDepth, BeginsNoDeeperThanUsualWhenTheSurfaceIsLeft) {
  Hand hand;
  hand.press(8.0, 6e-3, 0.0, 1.5);
  hand.depth.leave(kUsual_m);
  EXPECT_EQ(hand.depth.depth_m(kUsual_m), kUsual_m);
  hand.press(8.0, 1e-3, 0.0, 1.5);
  hand.depth.leave(kUsual_m);
  EXPECT_NEAR(hand.depth.depth_m(kUsual_m), 1e-3, 1e-4);
}

TEST(LocalTangent, IsTheSlopeWhereThatWasProbedWhateverTheLaw) {
  LocalTangent local;
  const auto force = [](double x) { return 2.0 * std::expm1(x / 1e-3); };
  double mean = 0.0, count = 0.0;
  for (double t = 0.0; t < 20.0; t += kDt) {
    const double w = 0.5 * std::numbers::pi, x = 1e-3 + 0.1e-3 * std::sin(w * t),
                 v = 0.1e-3 * w * std::cos(w * t);
    local.step({x, v, force(x) * (1.0 + 5.0 * v)}, 0.0, 4.0, kDt);
    mean += x, count += 1.0;
  }
  const ContactAnswer a = local.answer(0.0);
  ASSERT_TRUE(a.valid);
  EXPECT_NEAR(a.depth_m, mean / count, 3e-5);
  EXPECT_NEAR(a.stiffness.value, 2e3 * std::exp(a.depth_m / 1e-3), 0.03 * a.stiffness.value);
  EXPECT_NEAR(a.secant.value * a.depth_m, force(a.depth_m), 0.02 * force(a.depth_m));
}

TEST(LocalTangent, SaysNothingOfADepthThatDoesNotChange) {
  LocalTangent local;
  EXPECT_FALSE(local.answer(0.0).valid);
  for (int i = 0; i < 2000; ++i) local.step({1e-3, 0.0, 1.0}, 0.0, 4.0, kDt);
  EXPECT_FALSE(local.answer(0.0).valid);
}

TEST(WorkingDepth, ChangedContactStartsAtHandPosition) {
  WorkingDepth depth;
  depth.begin_at(7e-3);
  EXPECT_EQ(depth.depth_m(2e-3), 7e-3);
  depth.begin_at(-1e-3);  // in front of it
  EXPECT_EQ(depth.depth_m(2e-3), 2e-3);
}

}  // namespace
}  // namespace longreach::working_depth_test
