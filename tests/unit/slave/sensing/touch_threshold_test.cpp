#include "slave/sensing/touch_threshold.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "slave/sensing/contact_detector.hpp"

namespace longreach::touch_threshold_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kSpeed = 0.02;  // m/s

SensingConfig derived() {
  SensingConfig config;
  config.touch_n = 0.0;
  return config;
}

Vector3 drawn(Random& random, double sd) {
  return {sd * random.normal(), sd * random.normal(), sd * random.normal()};
}

/// Free motion with white noise of `sd`, for `seconds`.
void move(TouchThreshold& threshold, Random& random, double sd, double seconds, double dt = kDt) {
  for (double t = 0.0; t < seconds; t += dt) threshold.step(drawn(random, sd), kSpeed, true, dt);
}

TEST(TouchThreshold, IsEightDeviationsOfTheFilteredForceAndTheDriftOfTenSeconds) {
  const double kDrift_n = 0.05 * std::sqrt(10.0);
  for (const double sd : {0.01, 0.05, 0.5}) {
    // The deviation of a force that is filtered as contact detection filters it, from its definition.
    double squares = 0.0, filtered = 0.0;
    Random random(3);
    constexpr int kSamples = 200000;
    for (int i = 0; i < kSamples; ++i) {
      filtered += -std::expm1(-kDt / SensingConfig{}.filter_s) * (sd * random.normal() - filtered);
      squares += filtered * filtered / kSamples;
    }
    TouchThreshold threshold(derived());
    move(threshold, random, sd, 5.0);
    ASSERT_TRUE(threshold.known());
    EXPECT_NEAR(threshold.noise_n() / std::sqrt(squares), 1.0, 0.2) << sd;
    EXPECT_NEAR(threshold.touch_n(), 8.0 * threshold.noise_n() + kDrift_n, 1e-12);
    EXPECT_NEAR(threshold.release_n(), 0.4 * threshold.touch_n(), 1e-12);
  }
}

TEST(TouchThreshold, IsTheConfiguredBoundUntilTheNoiseIsKnown) {
  SensingConfig config = derived();
  config.force_noise_n = 0.5;
  TouchThreshold threshold(config);
  EXPECT_NEAR(threshold.touch_n(), 8.0 * 0.5 * 0.2236 + 0.05 * std::sqrt(10.0), 2e-3);
  EXPECT_EQ(TouchThreshold(derived()).touch_n(), 0.3);
  Random random(4);
  for (int i = 0; i < 10000; ++i) threshold.step(drawn(random, 0.01), kSpeed, false, kDt);
  EXPECT_FALSE(threshold.known()) << "in contact";
  for (int i = 0; i < 10000; ++i) threshold.step(drawn(random, 0.01), 0.004, true, kDt);
  EXPECT_FALSE(threshold.known()) << "at rest";
  move(threshold, random, 0.01, 0.009 / kSpeed);
  EXPECT_FALSE(threshold.known()) << "9 mm";
  move(threshold, random, 0.01, 1.0);
  EXPECT_TRUE(threshold.known());
  EXPECT_LT(threshold.touch_n(), 0.2);
}

// A sensor that is noisier than its file says makes no contact at rest, before it has moved.
TEST(TouchThreshold, RisesWithTheNoiseAtRestButDoesNotFallWithIt) {
  for (const double sd : {0.01, 0.4}) {
    TouchThreshold threshold(derived());
    Random random(10);
    const auto rest = [&](double seconds, double speed) {
      for (double t = 0.0; t < seconds; t += kDt) threshold.step(drawn(random, sd), speed, true, kDt);
    };
    rest(0.3, 0.0);
    const double noise_n = 0.2236 * sd, usual_n = 8.0 * noise_n + 0.05 * std::sqrt(10.0);
    for (int i = 0; i < 20; ++i) {
      EXPECT_GE(threshold.touch_n(), std::max(0.3, 0.5 * usual_n)) << sd;
      EXPECT_LE(threshold.touch_n(), std::max(0.3, 1.5 * usual_n)) << sd;
      rest(0.02, i < 10 ? 0.0 : kSpeed);
    }
    EXPECT_FALSE(threshold.known());
  }
}

TEST(TouchThreshold, LeavesOutBiasDriftAndSomeAccelerations) {
  TouchThreshold threshold(derived());
  Random random(5);
  Vector3 drift = Vector3(9.0, -3.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    drift += drawn(random, 0.05 * std::sqrt(kDt));
    const Vector3 inertia(i % 1000 < 100 ? 1.0 : 0.0, 0.0, 0.0);  // two steps a second
    threshold.step(drift + inertia + drawn(random, 0.05), kSpeed, true, kDt);
  }
  EXPECT_LT(threshold.noise_n(), 1.5 * 0.0112);
}

// At 125 Hz the filter smooths less.
TEST(TouchThreshold, MeasuresWhatTheFilterLeavesAtAnyRate) {
  constexpr double kSlow_s = 8e-3;
  TouchThreshold threshold(derived());
  Random random(6);
  move(threshold, random, 0.05, 5.0, kSlow_s);
  ContactDetector detector(SensingConfig{});
  detector.set_thresholds(threshold.touch_n(), threshold.release_n());
  EXPECT_GT(threshold.noise_n(), 0.02);
  for (int i = 0; i < 200000; ++i) ASSERT_FALSE(detector.step(drawn(random, 0.05), kSlow_s).in_contact) << i;
}

TEST(TouchThreshold, AConfiguredOneStays) {
  SensingConfig config;
  config.touch_n = 0.7;
  TouchThreshold threshold(config);
  Random random(7);
  move(threshold, random, 0.5, 5.0);
  EXPECT_FALSE(threshold.derived());
  EXPECT_EQ(threshold.touch_n(), 0.7);
}

TEST(TouchThreshold, IgnoresWhatIsNotFinite) {
  TouchThreshold threshold(derived());
  Random random(8);
  move(threshold, random, 0.05, 2.0);
  threshold.step(Vector3(std::nan(""), 0, 0), kSpeed, true, kDt);
  move(threshold, random, 0.05, 2.0);
  EXPECT_LT(threshold.touch_n(), 0.3);
}

}  // namespace
}  // namespace longreach::touch_threshold_test
