// The centre of rate mode: a handle that is not home when the mode begins moves nothing until it has been home.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "master/mapping/mapping.hpp"

namespace longreach::rate_centre_test {
namespace {

constexpr double kTick_s = 0.001;

/// A handle in rate mode, moved by at most 1 mm and 0.01 rad in a tick.
struct RateHandle {
  explicit RateHandle(const MappingConfig& config) : mapping(config) {
    mapping.reset({});
    in.mode = MotionMode::kPosition;
    mapping.step(in, kTick_s);
  }
  void move_to(const Vector3& x_m, int ticks = 100) { turn_to(x_m, log_rotation(in.handle.q_MH), ticks); }
  void turn_to(const Vector3& x_m, const Vector3& turn_rad, int ticks = 100) {
    for (int i = 0; i < ticks; ++i) {
      const Vector3 left = turn_rad - log_rotation(in.handle.q_MH);
      in.handle.p_MH += clamp_norm(x_m - in.handle.p_MH, 1e-3);
      in.handle.q_MH = exp_rotation(log_rotation(in.handle.q_MH) + clamp_norm(left, 0.01));
      const Vector3 before = mapping.goal().position_m;
      mapping.step(in, kTick_s);
      const double now = (mapping.goal().position_m - before).norm() / kTick_s;
      change_m_per_s = std::max(change_m_per_s, std::abs(now - speed_m_per_s));
      speed_m_per_s = now;
    }
  }
  void rate() { in.mode = MotionMode::kRate; }

  Mapping mapping;
  MappingInput in{};
  double speed_m_per_s = 0.0, change_m_per_s = 0.0;  // of the goal; largest change in a tick
};

TEST(RateCentre, HandleAwayFromHomeMovesNothingUntilItWasHome) {
  for (const RateLaw law : {RateLaw::kContinuous, RateLaw::kLiteral}) {
    RateHandle h({.rate_law = law});
    h.move_to({0.03, 0.0, 0.0});
    h.rate();
    h.move_to({0.03, 0.0, 0.0}, 1);
    const Vector3 goal = h.mapping.goal().position_m;
    EXPECT_TRUE(h.mapping.bring_home());
    EXPECT_FALSE(h.mapping.turn_home());
    h.move_to({0.04, 0.02, 0.0}, 1000);
    h.move_to({-0.03, 0.02, 0.0}, 1000);  // past home, not through it
    EXPECT_EQ(h.mapping.goal().position_m, goal);
    EXPECT_TRUE(h.mapping.deflection_m(h.in.handle).isZero(0.0));
    EXPECT_TRUE(h.mapping.centre_m().isZero(0.0)) << "the centring spring leads home";
    h.move_to({-0.003, 0.002, 0.0});
    EXPECT_FALSE(h.mapping.bring_home());
    EXPECT_EQ(h.mapping.goal().position_m, goal) << "inside the dead zone";
    h.move_to({0.015, 0.0, 0.0}, 1000);
    EXPECT_GT(h.mapping.goal().position_m.x(), goal.x() + 0.01);
  }
}

// The control: with the other centre, the handle moves the robot from where the mode began.
TEST(RateCentre, WhereTheModeBeganNeedsNoHome) {
  RateHandle h({.rate_centre = RateCentre::kWhereModeBegan});
  h.move_to({0.03, 0.0, 0.0});
  h.rate();
  h.move_to({0.03, 0.0, 0.0}, 1);
  const Vector3 goal = h.mapping.goal().position_m;
  EXPECT_FALSE(h.mapping.bring_home());
  h.move_to({0.045, 0.0, 0.0}, 1000);
  EXPECT_GT(h.mapping.goal().position_m.x(), goal.x() + 0.01);
}

TEST(RateCentre, EachHandleIsBroughtHomeOnItsOwn) {
  RateHandle h({});
  h.turn_to({0.0, 0.0, 0.0}, {0.0, 0.0, 0.3});
  h.rate();
  const Vector3 turn_rad = h.mapping.goal().rotation_rad;
  h.move_to({0.015, 0.0, 0.0}, 1000);
  EXPECT_TRUE(h.mapping.turn_home());
  EXPECT_FALSE(h.mapping.bring_home());
  EXPECT_GT(h.mapping.goal().position_m.x(), 0.01);
  EXPECT_LT((h.mapping.goal().rotation_rad - turn_rad).norm(), 1e-12);
  h.turn_to({0.0, 0.0, 0.0}, {0.0, 0.0, 0.02});
  EXPECT_FALSE(h.mapping.turn_home());
  h.turn_to({0.0, 0.0, 0.0}, {0.0, 0.0, 0.3}, 1000);
  EXPECT_GT((h.mapping.goal().rotation_rad - turn_rad).norm(), 0.05);
}

TEST(RateCentre, FrozenHandleAndPositionModeAskForNothing) {
  RateHandle h({});
  h.turn_to({0.03, 0.0, 0.0}, {0.0, 0.0, 0.3});
  EXPECT_FALSE(h.mapping.bring_home() || h.mapping.turn_home());
  h.rate();
  h.in.frozen = true;
  h.move_to({0.03, 0.0, 0.0});
  EXPECT_FALSE(h.mapping.bring_home() || h.mapping.turn_home()) << "clutched";
  h.in.frozen = false;
  h.move_to({0.03, 0.0, 0.0});
  EXPECT_TRUE(h.mapping.bring_home() && h.mapping.turn_home());
}

// Without a dead zone, the handle is home within 1 mm, where it is already deflected.
TEST(RateCentre, SpeedStartsWithoutAStepIfThereIsNoDeadZone) {
  RateHandle h({.kv_per_s = 10.0, .dead_zone_m = 0.0});
  h.move_to({0.03, 0.0, 0.0});
  h.rate();
  h.move_to({0.03, 0.0, 0.0}, 2);
  h.change_m_per_s = 0.0;
  h.move_to({0.0009, 0.0, 0.0}, 1000);
  EXPECT_FALSE(h.mapping.bring_home());
  EXPECT_NEAR(h.speed_m_per_s, 10.0 * 0.0009, 1e-5);
  EXPECT_LT(h.change_m_per_s, 0.011 * 10.0 * 0.001);
}

// The rule of the source paper for both handles at once.
TEST(SimultaneousMotion, TranslationAloneCountsWhileBothHandlesMove) {
  for (const MotionMode mode : {MotionMode::kPosition, MotionMode::kRate}) {
    for (const bool both : {false, true}) {
      RateHandle h({.speed_max_rad_per_s = 10.0,
                    .simultaneous = both ? SimultaneousMotion::kBoth : SimultaneousMotion::kTranslation});
      h.in.mode = mode;
      h.turn_to({0.0, 0.0, 0.0}, Vector3::Zero(), 1);
      h.move_to({0.012, 0.0, 0.0}, 20);  // it moves
      const Vector3 before_rad = h.mapping.goal().rotation_rad;
      h.turn_to({0.04, 0.0, 0.0}, {0.0, 0.0, 0.25}, 25);
      const double turned_rad = (h.mapping.goal().rotation_rad - before_rad).norm();
      EXPECT_GT(h.mapping.goal().position_m.x(), 1e-4);
      EXPECT_EQ(turned_rad > 1e-4, both) << turned_rad;
      if (!both) {
        EXPECT_EQ(turned_rad, 0.0);
      }
      // After the translation, the rotation counts from where the handle then is, or by its deflection.
      h.turn_to(mode == MotionMode::kRate ? Vector3(Vector3::Zero()) : h.in.handle.p_MH, {0.0, 0.0, 0.25},
                1000);
      const Vector3 rest_rad = h.mapping.goal().rotation_rad;
      if (!both && mode == MotionMode::kPosition) {
        EXPECT_LT((rest_rad - before_rad).norm(), 1e-12);
      }
      h.turn_to(h.in.handle.p_MH, {0.0, 0.0, 0.35}, 300);
      EXPECT_GT((h.mapping.goal().rotation_rad - rest_rad).norm(), 0.01);
    }
  }
}

}  // namespace
}  // namespace longreach::rate_centre_test
