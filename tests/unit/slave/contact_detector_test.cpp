#include "slave/sensing/contact_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach {
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
  constexpr double kDoubt_n = 2.0;
  ContactDetector detector(SensingConfig{});
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(detector.step(Vector3(-2.2, 0, 0), kDt, kDoubt_n).in_contact);
  bool touches = false;
  for (int i = 0; i < 200; ++i) touches = detector.step(Vector3(-2.4, 0, 0), kDt, kDoubt_n).in_contact;
  EXPECT_TRUE(touches);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(detector.step(Vector3(-1.0, 0, 0), kDt, kDoubt_n).in_contact);
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
}  // namespace longreach
