// What encoders say of a motion, and what of it is certain.

#include "master/devices/quantized_motion_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::quantized_motion_filter_test {
namespace {

constexpr double kTick_s = 1e-3, kCount = 1e-5;

TEST(QuantizedMotionFilter, IsNoneWhileAnEncoderGoesToAndFroByOneCount) {
  QuantizedVelocityFilter v(0.5 * kCount);
  const Vector3 count(kCount, 0.0, 0.0);
  v.step(count, kTick_s, 0.0);
  for (int i = 0; i < 1000; ++i)
    EXPECT_TRUE(v.step(i % 2 == 0 ? -count : count, kTick_s, 0.0).isZero(0.0)) << i;
}

TEST(QuantizedMotionFilter, IsNoneWhileAllThreeGoToAndFroByTheirCounts) {
  QuantizedVelocityFilter v(0.51 * std::sqrt(3.0) * kCount);
  Random random(3);
  Vector3 at = Vector3::Zero();
  double late = 0.0;
  for (int i = 0; i < 4000; ++i) {
    Vector3 next;
    for (int j = 0; j < 3; ++j) next[j] = random.chance(0.5) ? kCount : 0.0;
    const double speed = v.step(next - at, kTick_s, 0.0).norm();
    at = next;
    if (i > 3000) late = std::max(late, speed);
  }
  EXPECT_EQ(late, 0.0);
}

TEST(QuantizedMotionFilter, IsThatOfTheEncodersInOneDirection) {
  QuantizedVelocityFilter v(0.5 * kCount);
  Vector3 last = Vector3::Zero();
  for (int i = 0; i < 500; ++i) last = v.step(Vector3(5.0 * kCount, 0.0, 0.0), kTick_s, 0.002);
  EXPECT_NEAR(last.x(), 5.0 * kCount / kTick_s, 1e-9);
}

TEST(QuantizedMotionFilter, NeverPointsAgainstTheTrueOne) {
  QuantizedVelocityFilter v(0.5 * kCount);
  Random random(5);
  double x = 0.0, measured = 0.0, speed = 0.0;
  int moved = 0;
  for (int i = 0; i < 20000; ++i) {
    speed += 0.3 * kCount * random.normal() - 0.01 * speed;
    x += speed;
    const double now = std::round(x / kCount) * kCount;
    const double rate = v.step(Vector3(now - measured, 0.0, 0.0), kTick_s, 0.0).x();
    measured = now;
    EXPECT_GE(rate * speed, 0.0) << i;
    moved += rate != 0.0;
  }
  EXPECT_GT(moved, 1000);
}

// A count every tenth of a second is a slow motion.
TEST(QuantizedMotionFilter, IsNoBlowWhenACountComesAlone) {
  QuantizedVelocityFilter v(0.5 * kCount);
  double fastest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double moved = i % 100 == 99 ? kCount : 0.0;
    const double speed = v.step(Vector3(moved, 0.0, 0.0), kTick_s, 0.002).x();
    if (i > 200) fastest = std::max(fastest, speed);
  }
  EXPECT_GT(fastest, 0.0);
  EXPECT_LT(fastest, 0.25 * kCount / (3.0 * kTick_s));  // of what the filter leaves of a blow
}

TEST(QuantizedMotionFilter, PutsAHandleAtRestThatGoesToAndFroAndGetsNowhere) {
  QuantizedMotionFilter motion({.m = 5e-6, .rad = 5e-6}, 0.0);
  HandleState at;
  std::vector<double> places, angles;
  for (int i = 0; i < 200; ++i) {
    at.p_MH.x() = i % 2 == 0 ? 0.0 : 1e-5;
    at.q_MH = exp_rotation(at.p_MH);
    const HandleState reported = motion.step(at, kTick_s);
    places.push_back(reported.p_MH.x());
    angles.push_back(log_rotation(reported.q_MH).x());
  }
  EXPECT_EQ(places[5], 1e-5);  // as measured at first
  for (std::size_t i = 100; i < 200; ++i) {
    EXPECT_NEAR(places[i], 5e-6, 1e-15) << i;
    EXPECT_NEAR(angles[i], 5e-6, 1e-15) << i;
  }
  at.p_MH.x() = 3e-5;  // it goes: as measured again
  EXPECT_EQ(motion.step(at, kTick_s).p_MH.x(), 3e-5);
  at.p_MH.x() = 2.5e-5;
  EXPECT_EQ(motion.step(at, kTick_s).p_MH.x(), 2.5e-5);
}

TEST(QuantizedMotionFilter, TakesThePlaceOfWhatADeviceSaysOfItsVelocities) {
  QuantizedMotionFilter motion({.m = 5e-6, .rad = 5e-6}, 0.0);
  HandleState at;
  at.velocity_m_per_s = {9.0, 9.0, 9.0};
  at.angular_rad_per_s = {9.0, 9.0, 9.0};
  EXPECT_TRUE(motion.step(at, kTick_s).velocity_m_per_s.isZero(0.0));
  at.p_MH.x() = 1e-3;
  at.q_MH = Eigen::AngleAxisd(1e-3, Vector3::UnitZ());
  const HandleState reported = motion.step(at, kTick_s);
  EXPECT_NEAR(reported.velocity_m_per_s.x(), (1e-3 - 5e-6) / kTick_s, 1e-9);
  EXPECT_NEAR(reported.angular_rad_per_s.z(), (1e-3 - 5e-6) / kTick_s, 1e-9);
}

}  // namespace
}  // namespace longreach::quantized_motion_filter_test
