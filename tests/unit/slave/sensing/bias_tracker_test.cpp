#include "slave/sensing/bias_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"

namespace longreach::bias_tracker_test {
namespace {

constexpr double kDt = 1e-3, kDrift_n = 0.05, kGuard_n = 20.0, kTouch_n = 0.25;

const Vector3 kBias(6.0, -5.0, 3.0);

struct Motion {
  double speed_m_per_s = 0.02;
  bool free = true, load_known = true;
  double uncertainty_n = 0.0;
};

/// A force of `force_n` for `seconds`.
void feel(BiasTracker& tracker, const Vector3& force_n, double seconds, const Motion& motion = {}) {
  for (double t = 0.0; t < seconds - 0.5 * kDt; t += kDt)
    tracker.step(
        {force_n, motion.speed_m_per_s, motion.free, motion.load_known, motion.uncertainty_n, kTouch_n, kDt});
}

BiasTracker zeroed(const Vector3& bias_n) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  feel(tracker, bias_n, 2.0);
  EXPECT_TRUE(tracker.known());
  return tracker;
}

TEST(BiasTracker, TakesNoZeroBeforeTenMillimetresOfFreeMotion) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  feel(tracker, kBias, 10.0, {.speed_m_per_s = 0.0});
  feel(tracker, kBias, 10.0, {.speed_m_per_s = 0.004});
  feel(tracker, kBias, 10.0, {.free = false});
  feel(tracker, kBias, 10.0, {.load_known = false});
  feel(tracker, kBias, 10.0, {.uncertainty_n = 1.0});
  EXPECT_FALSE(tracker.known());
  feel(tracker, kBias, 0.49);
  EXPECT_FALSE(tracker.known());
  EXPECT_NEAR(tracker.missing_m(), 0.0002, 1e-5);
  EXPECT_EQ(tracker.bias_n(), Vector3::Zero()) << "the guards see every force";
  feel(tracker, kBias, 0.02);
  ASSERT_TRUE(tracker.known());
  EXPECT_EQ(tracker.zeros(), 1U);
  EXPECT_LT((tracker.bias_n() - kBias).norm(), 1e-9);
  EXPECT_NEAR(tracker.logged_n(), kBias.norm(), 1e-9);
}

TEST(BiasTracker, AForceThatChangesWithTheMotionIsNoBias) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  for (int i = 0; i < 5000; ++i)  // 20 mm/s on 100 N/m, up and down again
    tracker.step({Vector3(-2.0 + std::abs(std::fmod(2e-3 * i, 2.0) - 1.0), 0, 0), 0.02, true, true, 0.0,
                  kTouch_n, kDt});
  EXPECT_FALSE(tracker.known());
}

TEST(BiasTracker, ReportsWhatMayBeTheBiasUntilTheFirstZero) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  feel(tracker, kBias, 0.2, {.speed_m_per_s = 0.0});
  EXPECT_LT((tracker.possible_n() - kBias).norm(), 1e-9);
  feel(tracker, 0.6 * kBias, 0.2, {.speed_m_per_s = 0.0});
  EXPECT_LT((tracker.possible_n() - kBias).norm(), 1e-9) << "as it was at the start";
  feel(tracker, kBias, 2.0);
  EXPECT_EQ(tracker.possible_n(), Vector3::Zero());
}

TEST(BiasTracker, RefusesAZeroThatWouldHideTooMuchOfTheGuard) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  feel(tracker, Vector3(0, 0, -12.5), 2.0);
  EXPECT_FALSE(tracker.known());
  EXPECT_NEAR(tracker.refused_n(), 12.5, 1e-9);
  feel(tracker, Vector3(0, 0, -11.5), 2.0);
  EXPECT_TRUE(tracker.known());
  EXPECT_EQ(tracker.refused_n(), 0.0);
  feel(tracker, Vector3(0, 0, -16.0), 60.0);
  EXPECT_NEAR(tracker.bias_n().norm(), 15.0, 1e-6);
  EXPECT_GT(tracker.refused_n(), 15.0);
}

TEST(BiasTracker, FollowsOnlyInFreeMotionWithALoadThatIsKnown) {
  BiasTracker tracker = zeroed(kBias);
  const Vector3 more = kBias + Vector3(0.2, 0, 0);
  feel(tracker, more, 100.0, {.speed_m_per_s = 0.004});
  feel(tracker, more, 100.0, {.free = false});
  feel(tracker, more, 100.0, {.load_known = false});
  EXPECT_LT((tracker.bias_n() - kBias).norm(), 1e-12);
  EXPECT_NEAR(tracker.uncertainty_n(), kDrift_n * std::sqrt(300.0), 1e-3);
  feel(tracker, more, 10.0);
  EXPECT_LT((tracker.bias_n() - more).norm(), 1e-3);
  EXPECT_LT(tracker.uncertainty_n(), 0.01);
}

TEST(BiasTracker, FollowsNoFasterThanThreeTimesTheDrift) {
  BiasTracker tracker = zeroed(kBias);
  feel(tracker, kBias + Vector3(0, 10.0, 0), 4.0);
  EXPECT_LE((tracker.bias_n() - kBias).norm(), 4.0 * 3.0 * kDrift_n + 1e-9);
  EXPECT_GE((tracker.bias_n() - kBias).norm(), 3.5 * 3.0 * kDrift_n);
}

// 0.1 mm/s on 200 N/m: the tool is as good as at rest.
TEST(BiasTracker, ASlowContactIsNotTakenForDrift) {
  BiasTracker tracker = zeroed(kBias);
  for (int i = 0; i < 20000; ++i)
    tracker.step({kBias + Vector3(-0.02 * kDt * i, 0, 0), 1e-4, true, true, 0.0, kTouch_n, kDt});
  EXPECT_LT((tracker.bias_n() - kBias).norm(), 1e-12);
}

TEST(BiasTracker, KeepsADriftForAnHourWithinTheThreshold) {
  BiasTracker tracker = zeroed(Vector3::Zero());
  Random random(9);
  Vector3 bias = Vector3::Zero();
  double most_n = 0.0;
  for (int i = 0; i < 3600000; ++i) {
    bias += kDrift_n * std::sqrt(kDt) * Vector3(random.normal(), random.normal(), random.normal());
    tracker.step({bias, 0.25, true, true, 0.0, kTouch_n, kDt});
    most_n = std::max(most_n, (tracker.bias_n() - bias).norm());
    if (bias.norm() > 10.0) bias.setZero(), tracker = zeroed(bias);
  }
  EXPECT_LT(most_n, kDrift_n * std::sqrt(10.0) + 0.09);
  EXPECT_GT(tracker.zeros(), 2U) << "each is logged when it has moved by a touch";
}

TEST(BiasTracker, IgnoresWhatIsNotFinite) {
  BiasTracker tracker = zeroed(kBias);
  feel(tracker, Vector3(std::nan(""), 0, 0), 0.1);
  feel(tracker, kBias, 0.1);
  EXPECT_LT((tracker.bias_n() - kBias).norm(), 1e-9);
}

TEST(BiasTracker, AForceAtTheStartThatVanishesWasNoBias) {
  BiasTracker tracker(kDrift_n, kGuard_n);
  feel(tracker, kBias, 1.0, {.speed_m_per_s = 0.0});
  EXPECT_NEAR(tracker.possible_n().norm(), kBias.norm(), 1e-9);
  feel(tracker, 0.6 * kBias, 1.0, {.speed_m_per_s = 0.0});
  feel(tracker, Vector3::Zero(), 1.0, {.speed_m_per_s = 0.0, .free = false});
  EXPECT_FALSE(tracker.possible_n().isZero(0.0)) << "a contact may push against it";
  feel(tracker, Vector3::Zero(), 0.2, {.speed_m_per_s = 0.0});
  EXPECT_TRUE(tracker.possible_n().isZero(0.0));
}

}  // namespace
}  // namespace longreach::bias_tracker_test
