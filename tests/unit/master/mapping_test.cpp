#include "master/mapping/mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/core/random.hpp"

namespace longreach {
namespace {

constexpr double kTick_s = 0.001;

MappingInput at(const Vector3& x, MotionMode mode, double scale, bool frozen = false) {
  MappingInput in;
  in.handle.p_MH = x;
  in.mode = mode;
  in.scale = scale;
  in.frozen = frozen;
  return in;
}

TEST(RateLaw, IsZeroInsideTheDeadZoneAndContinuousAtItsEdge) {
  EXPECT_TRUE(rate_law({0.004, 0.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous).isZero(0.0));
  EXPECT_NEAR(rate_law({0.005 + 1e-9, 0.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous).x(), 1e-9, 1e-15);
  EXPECT_NEAR(rate_law({0.005 + 1e-9, 0.0, 0.0}, 0.005, 0.05, RateLaw::kLiteral).x(), 0.005, 1e-8);
}

TEST(RateLaw, CapsAtTheEffectiveRadiusAndKeepsTheDirection) {
  const Vector3 v = rate_law({3.0, 4.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous);
  EXPECT_NEAR(v.norm(), 0.045, 1e-15);
  EXPECT_NEAR(v.y() / v.x(), 4.0 / 3.0, 1e-12);
}

TEST(Mapping, ScalesTheDisplacementOfTheHandleInPositionMode) {
  Mapping mapping({.speed_max_m_per_s = 10.0});
  mapping.reset({});
  mapping.step(at(Vector3::Zero(), MotionMode::kPosition, 0.5), kTick_s);
  EXPECT_NEAR(mapping.step(at({0.004, 0.0, -0.002}, MotionMode::kPosition, 0.5), kTick_s).position_m.x(),
              0.002, 1e-15);
  EXPECT_NEAR(mapping.goal().position_m.z(), -0.001, 1e-15);
}

TEST(Mapping, IntegratesTheRateOfADeflection) {
  Mapping mapping({.kv_per_s = 2.0, .dead_zone_m = 0.005, .radius_max_m = 0.05});
  mapping.reset({});
  mapping.step(at(Vector3::Zero(), MotionMode::kRate, 1.0), kTick_s);
  for (int i = 0; i < 1000; ++i) mapping.step(at({0.015, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
  EXPECT_NEAR(mapping.goal().position_m.x(), 2.0 * 0.010, 1e-12);
}

TEST(Mapping, TurnsTheGoalByTheScaledRotationOfTheHandle) {
  Mapping mapping({.speed_max_rad_per_s = 1e4});
  mapping.reset({});
  MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 0.5);
  mapping.step(in, kTick_s);
  in.handle.q_MH = exp_rotation({0.0, 0.0, 0.6});
  EXPECT_NEAR(log_rotation(mapping.step(in, kTick_s).rotation).z(), 0.3, 1e-12);
}

TEST(Mapping, SaysWhereTheHandleMeetsAPlaneOfTheGoal) {
  Mapping mapping({.speed_max_m_per_s = 10.0});
  mapping.reset({});
  mapping.step(at({0.001, 0.0, 0.0}, MotionMode::kPosition, 0.2), kTick_s);
  mapping.step(at({0.006, 0.0, 0.0}, MotionMode::kPosition, 0.2), kTick_s);
  EXPECT_NEAR(mapping.goal().position_m.x(), 0.001, 1e-15);
  EXPECT_NEAR(mapping.handle_offset_m(Vector3::UnitX(), 0.001), 0.006, 1e-15);
}

/// No change of mode, scale or clutch moves the goal by itself, with the hand anywhere.
TEST(Mapping, IsBumplessAtEveryChange) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    Mapping mapping({.speed_max_m_per_s = 100.0, .speed_max_rad_per_s = 1e3});
    mapping.reset({});
    MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 0.8);
    for (int i = 0; i < 300; ++i) {
      in.handle.p_MH += 1e-3 * Vector3(random.normal(), random.normal(), random.normal());
      in.handle.q_MH =
          exp_rotation(0.02 * Vector3(random.normal(), random.normal(), random.normal())) * in.handle.q_MH;
      mapping.step(in, kTick_s);
      const Goal before = mapping.goal();
      if (random.chance(0.3))
        in.mode = in.mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
      if (random.chance(0.3)) in.scale = 0.05 * std::floor(random.uniform(1.0, 21.0));
      if (random.chance(0.3)) in.frozen = !in.frozen;
      mapping.step(in, kTick_s);
      if (in.mode == MotionMode::kRate && !in.frozen) continue;  // rate mode moves on by design
      ASSERT_LE((mapping.goal().position_m - before.position_m).norm(), 1e-12) << "seed " << seed;
      ASSERT_LE(log_rotation(mapping.goal().rotation * before.rotation.conjugate()).norm(), 1e-12)
          << "seed " << seed;
    }
  }
}

TEST(Mapping, SwitchingToRateModeAtADeflectionCommandsNoSpeed) {
  Mapping mapping({});
  mapping.reset({});
  mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  const Vector3 before = mapping.goal().position_m;
  for (int i = 0; i < 100; ++i) mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
  EXPECT_EQ(mapping.goal().position_m, before);
}

TEST(Mapping, LettingGoInRateModeCommandsNothing) {
  Mapping mapping({});
  mapping.reset({});
  mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  const Vector3 before = mapping.goal().position_m;
  for (int i = 0; i <= 1000; ++i) {
    mapping.step(at({0.04 - 4e-5 * i, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
  }
  EXPECT_EQ(mapping.goal().position_m, before);
}

TEST(Mapping, KeepsTheGoalWhenTheHandleIsNotFinite) {
  Mapping mapping({});
  mapping.reset({});
  mapping.step(at({0.01, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  const Vector3 before = mapping.goal().position_m;
  mapping.step(at({std::nan(""), 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  EXPECT_EQ(mapping.goal().position_m, before);
}

}  // namespace
}  // namespace longreach
