#include "slave/sensing/contact_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach::contact_detector_test {
namespace {

constexpr double kDt = 1e-3;

ContactReading settle(ContactDetector& detector, const Vector3& force, int ticks = 200) {
  ContactReading reading;
  for (int i = 0; i < ticks; ++i) reading = detector.step(force, kDt);
  return reading;
}

TEST(ContactDetector, TouchesAboveOneForceAndReleasesBelowAnother) {
  ContactDetector detector(SensingConfig{});
  EXPECT_FALSE(settle(detector, Vector3(-0.29, 0, 0)).in_contact);
  EXPECT_TRUE(settle(detector, Vector3(-0.31, 0, 0)).in_contact);
  EXPECT_TRUE(settle(detector, Vector3(-0.13, 0, 0)).in_contact);
  EXPECT_FALSE(settle(detector, Vector3(-0.11, 0, 0)).in_contact);
  EXPECT_FALSE(settle(detector, Vector3(-0.29, 0, 0)).in_contact);
}

TEST(ContactDetector, WhatMayBeNoForceMakesNoContactButEndsNoneEither) {
  constexpr double kUncertainty_n = 2.0;
  ContactDetector detector(SensingConfig{});
  for (int i = 0; i < 200; ++i)
    ASSERT_FALSE(detector.step(Vector3(-2.2, 0, 0), kDt, kUncertainty_n).in_contact);
  bool touches = false;
  for (int i = 0; i < 200; ++i) touches = detector.step(Vector3(-2.4, 0, 0), kDt, kUncertainty_n).in_contact;
  EXPECT_TRUE(touches);
  for (int i = 0; i < 200; ++i)
    ASSERT_TRUE(detector.step(Vector3(-1.0, 0, 0), kDt, kUncertainty_n).in_contact);
}

TEST(ContactDetector, WhatMayBeTheBiasIsNoContactUntilItChanges) {
  const Vector3 bias_n(6.0, 0, 0);
  const auto step = [&](ContactDetector& detector, const Vector3& force_n) {
    ContactReading reading;
    for (int i = 0; i < 200; ++i) reading = detector.step(force_n, kDt, 0.0, bias_n);
    return reading;
  };
  ContactDetector biased(SensingConfig{});
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(biased.step(bias_n, kDt, 0.0, bias_n).in_contact) << i;
  EXPECT_TRUE(step(biased, bias_n - Vector3(0.4, 0, 0)).in_contact);
  ContactDetector pressed(SensingConfig{});
  (void)step(pressed, bias_n);
  EXPECT_TRUE(step(pressed, 1.5 * bias_n).in_contact);
  EXPECT_FALSE(step(pressed, Vector3::Zero()).in_contact) << "what pressed at the start is gone";
}

TEST(ContactDetector, AZeroMakesNoContact) {
  const Vector3 bias_n(6.0, 0, 0);
  ContactDetector detector(SensingConfig{});
  for (int i = 0; i < 200; ++i) (void)detector.step(bias_n, kDt, 0.0, bias_n);
  detector.subtract(bias_n);
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(detector.step(Vector3::Zero(), kDt).in_contact) << i;
}

TEST(ContactDetector, AGreatForceThatWasThereDoesNotHideWhatPressesNow) {
  ContactDetector detector(SensingConfig{});
  settle(detector, Vector3(60, -180, 40), 2000);
  EXPECT_GT(settle(detector, Vector3(-20, 0, 0), 2000).normal.dot(-Vector3::UnitX()), 0.7);
}

TEST(ContactDetector, AnnouncesBeginAndEndOnce) {
  ContactDetector detector(SensingConfig{});
  int began = 0, ended = 0;
  for (int i = 0; i < 600; ++i) {
    const ContactReading r = detector.step(Vector3(0, (i / 200) % 2 == 1 ? 2.0 : 0.0, 0), kDt);
    began += r.began;
    ended += r.ended;
  }
  EXPECT_EQ(began, 1);
  EXPECT_EQ(ended, 1);
}

TEST(ContactDetector, NoiseAloneIsNoContact) {
  ContactDetector detector(SensingConfig{});
  Random random(5);
  for (int i = 0; i < 600000; ++i) {
    const Vector3 noise(0.05 * random.normal(), 0.05 * random.normal(), 0.05 * random.normal());
    ASSERT_FALSE(detector.step(noise, kDt).in_contact) << "tick " << i;
  }
}

Vector3 drawn(Random& random, double sd) {
  return {sd * random.normal(), sd * random.normal(), sd * random.normal()};
}

// Its first samples may be as those of a stiff wall: then the touch ends with the noise.
TEST(ContactDetector, ASensorThatBecomesTwentyTimesAsNoisyMakesNoContact) {
  ContactDetector detector(SensingConfig{});
  Random random(6);
  int touched = 0;
  for (int i = 0; i < 200000; ++i) {
    const int at = i % 2000;  // noisy from 1000 on
    const ContactReading r = detector.step(drawn(random, at >= 1000 ? 1.0 : 0.05), kDt);
    touched += r.began;
    ASSERT_FALSE(r.began && (at < 1000 || at > 1010)) << "tick " << i;
    ASSERT_FALSE(r.in_contact && at > 100 && at < 1000) << "tick " << i;
  }
  EXPECT_LE(touched, 5) << "of 100";
}

TEST(ContactDetector, FindsAContactInSuchNoiseAndALightOneSoonAfterIt) {
  ContactDetector detector(SensingConfig{});
  Random random(7);
  const auto ticks_to_touch = [&](const Vector3& force, double sd) {
    for (int i = 1; i <= 1000; ++i)
      if (detector.step(force + drawn(random, sd), kDt).in_contact) return i;
    return 1001;
  };
  for (int i = 0; i < 500; ++i) (void)detector.step(drawn(random, 1.0), kDt);
  EXPECT_LE(ticks_to_touch(Vector3(-4.0, 0, 0), 1.0), 50);
  for (int i = 0; i < 500; ++i) (void)detector.step(drawn(random, 1.0), kDt);
  EXPECT_LE(ticks_to_touch(Vector3(-0.4, 0, 0), 0.05), 200);
}

TEST(ContactDetector, NoiseAndJumpsEndNoContact) {
  ContactDetector detector(SensingConfig{});
  Random random(9);
  settle(detector, Vector3(-0.6, 0, 0));
  for (int i = 0; i < 2000; ++i) {
    const Vector3 jump(i % 100 == 0 ? -20.0 : 0.0, 0, 0);
    ASSERT_TRUE(detector.step(Vector3(-2.0, 0, 0) + jump + drawn(random, 1.0), kDt).in_contact)
        << "tick " << i;
  }
}

TEST(ContactDetector, ASpikeDoesNotDeafenIt) {
  for (const double spike : {10.0, 1e3, 1e300}) {
    ContactDetector detector(SensingConfig{});
    Random random(8);
    for (int i = 0; i < 500; ++i) (void)detector.step(drawn(random, 0.05), kDt);
    (void)detector.step(Vector3(spike, 0, 0), kDt);
    for (int i = 0; i < 5; ++i) (void)detector.step(Vector3::Zero(), kDt);
    EXPECT_LT(detector.step(Vector3::Zero(), kDt).touch_n, 2.0 * configured_touch_n({})) << spike;
  }
}

TEST(ContactDetector, AveragesTheNormalOverTheContact) {
  ContactDetector detector(SensingConfig{});
  Random random(6);
  const Vector3 normal = Vector3(-1, 0.3, 0.2).normalized();
  ContactReading reading;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 noise(0.05 * random.normal(), 0.05 * random.normal(), 0.05 * random.normal());
    reading = detector.step(1.0 * normal + noise, kDt);
  }
  EXPECT_NEAR(reading.normal.norm(), 1.0, 1e-12);
  EXPECT_LT((reading.normal - normal).norm(), 0.006);  // 4 sd of the mean of 2000 samples
}

TEST(ContactDetector, NormalFollowsAnEdgeThatIsSlidOver) {
  ContactDetector detector(SensingConfig{});
  ContactReading reading;
  for (int i = 0; i < 20000; ++i) reading = detector.step(Vector3(-1, 0, 0), kDt);
  for (int i = 0; i < 10000; ++i) reading = detector.step(Vector3(0, -1, 0), kDt);
  EXPECT_LT((reading.normal - Vector3(0, -1, 0)).norm(), 0.01);  // e^-5
}

TEST(ContactDetector, LeavesOutWhatIsNotFinite) {
  ContactDetector detector(SensingConfig{});
  settle(detector, Vector3(-1, 0, 0));
  const ContactReading r = detector.step(Vector3(std::numeric_limits<double>::quiet_NaN(), 0, 0), kDt);
  EXPECT_TRUE(r.in_contact);
  EXPECT_TRUE(r.filtered_n.allFinite());
  EXPECT_EQ(detector.ignored(), 1U);
}

}  // namespace
}  // namespace longreach::contact_detector_test
