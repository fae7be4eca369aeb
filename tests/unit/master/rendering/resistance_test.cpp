#include "master/rendering/resistance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"

namespace longreach::resistance_test {
namespace {

constexpr double kTick_s = 0.001;

struct Bench {
  explicit Bench(const RenderingConfig& c = {}) : config(c), resistance(config) {
    resistance.reset(in.handle);
  }
  Wrench rest(int ticks) {
    in.handle.velocity_m_per_s.setZero();
    in.handle.angular_rad_per_s.setZero();
    Wrench F;
    for (int i = 0; i < ticks; ++i) F = resistance.step(in, kTick_s);
    return F;
  }
  /// To a place on a straight way at a speed; answers the wrench on arrival, still moving.
  Wrench move(const Vector3& to, double speed_m_per_s) {
    const Vector3 way = to - in.handle.p_MH;
    const int ticks = std::max(1, static_cast<int>(std::lround(way.norm() / (speed_m_per_s * kTick_s))));
    const Vector3 from = in.handle.p_MH;
    in.handle.velocity_m_per_s = way / (ticks * kTick_s);
    Wrench F;
    for (int i = 1; i <= ticks; ++i) {
      in.handle.p_MH = from + way * (static_cast<double>(i) / ticks);
      F = resistance.step(in, kTick_s);
    }
    return F;
  }
  Wrench turn(const Vector3& to_rad, double speed_rad_per_s) {
    const Vector3 way = to_rad - log_rotation(in.handle.q_MH);
    const int ticks = static_cast<int>(std::lround(way.norm() / (speed_rad_per_s * kTick_s)));
    const Quaternion from = in.handle.q_MH;
    in.handle.angular_rad_per_s = way / (ticks * kTick_s);
    Wrench F;
    for (int i = 1; i <= ticks; ++i) {
      in.handle.q_MH = exp_rotation(way * (static_cast<double>(i) / ticks)) * from;
      F = resistance.step(in, kTick_s);
    }
    return F;
  }

  RenderingConfig config;
  Resistance resistance;
  ResistanceInput in{};
};

TEST(Resistance, IsASpringAndADamperInRateMode) {
  Bench b;
  b.in.mode = MotionMode::kRate;
  b.in.centre_m = {0.001, 0.0, 0.0};
  b.in.handle.p_MH = b.in.centre_m;
  b.resistance.reset(b.in.handle);
  b.rest(2000);
  const Vector3 moving = b.move({0.021, 0.0, 0.0}, 0.02).force;
  EXPECT_NEAR(moving.x(), -60.0 * 0.020 - 4.0 * 0.02, 1e-3);
  EXPECT_NEAR(b.rest(1).force.x(), -60.0 * 0.020, 1e-3);
  EXPECT_NEAR(b.resistance.energy_j(), 0.5 * 60.0 * 0.020 * 0.020, 1e-6);
}

TEST(Resistance, IsAsMuchStiffenedByALoadAsConfigured) {
  Bench b({.load_factor = 2.0});
  b.in.mode = MotionMode::kRate;
  b.in.load = true;
  b.rest(1);
  b.move({0.020, 0.0, 0.0}, 0.05);
  EXPECT_NEAR(b.rest(2000).force.x(), -2.0 * 60.0 * 0.020, 1e-6);
}

TEST(Resistance, TakesALoadWithoutAStepAndThenAsMotionPaysForIt) {
  Bench b({.load_factor = 1.5});
  b.in.mode = MotionMode::kRate;
  b.rest(1);
  b.move({0.020, 0.0, 0.0}, 0.05);
  const double before_n = b.rest(2000).force.x();
  b.in.load = true;
  EXPECT_NEAR(b.rest(1).force.x(), before_n, 1e-9);
  EXPECT_NEAR(b.rest(2000).force.x(), before_n, 1e-9) << "a hand that rests pays for nothing";
  for (int i = 0; i < 20; ++i) b.move({i % 2 == 0 ? 0.0 : 0.020, 0.0, 0.0}, 0.05);
  EXPECT_NEAR(b.rest(1).force.x(), 1.5 * before_n, 1e-3);
  b.in.load = false;
  EXPECT_NEAR(b.rest(1).force.x(), 1.5 * before_n, 0.01) << "eases, does not drop";
  EXPECT_NEAR(b.rest(3000).force.x(), before_n, 1e-3);
}

TEST(Resistance, ReleasesSpringSmoothlyWhenGoalFreezes) {
  Bench b;
  b.in.mode = MotionMode::kRate;
  b.rest(1);
  b.move({0.020, 0.0, 0.0}, 0.05);
  const double before_n = b.rest(1).force.x();
  b.in.frozen = true;
  EXPECT_NEAR(b.rest(1).force.x(), before_n, 0.01);
  EXPECT_NEAR(b.rest(200).force.x(), before_n * std::exp(-1.0), 0.01);
  EXPECT_EQ(b.rest(5000).force.norm(), 0.0);
}

TEST(Resistance, RubsInverselyToTheScaleInPositionMode) {
  for (const double scale : {0.05, 0.2, 0.5, 1.0}) {
    Bench b({.friction_n = 0.1, .friction_nm = 0.002});
    b.in.scale = scale;
    const Vector3 way(0.0, -0.02, 0.0);
    EXPECT_LE((b.move(way, 0.03).force - Vector3(0.0, 0.1 / scale, 0.0)).norm(), 1e-9);
    b.in.handle.angular_rad_per_s.setZero();
    const Vector3 moment = b.turn({0.3, 0.0, 0.0}, 0.5).moment;
    EXPECT_NEAR(moment.x(), -0.002 / scale - b.config.rotational_damping_nm_s_per_rad * 0.5, 1e-4);
  }
}

/// The creep before it slides, and that noise is felt as its stiffness times itself.
TEST(Resistance, IsQuietAtRest) {
  Bench b({.friction_n = 0.1, .friction_stiffness_n_per_m = 1000.0});
  b.move({0.01, 0.0, 0.0}, 0.02);
  const Vector3 held = b.rest(1).force;
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    b.in.handle.p_MH.x() = 0.01 - 1e-5 * std::floor(random.uniform(0.0, 2.0));
    EXPECT_LE((b.rest(1).force - held).norm(), 1000.0 * 1.001e-5);
  }
}

TEST(Resistance, EasesToACoarserScaleAndGrowsWithMotionToAFinerOne) {
  Bench b({.fade_s = 0.2, .friction_n = 0.1});
  b.in.scale = 0.05;
  b.move({0.02, 0.0, 0.0}, 0.02);
  const double fine_n = b.rest(1).force.x();
  EXPECT_NEAR(fine_n, -2.0, 1e-9);
  b.in.scale = 0.1;
  EXPECT_NEAR(b.rest(1).force.x(), fine_n, 0.0051);
  EXPECT_NEAR(b.rest(199).force.x(), -1.0 - std::exp(-1.0), 1e-3);
  EXPECT_NEAR(b.rest(5000).force.x(), -1.0, 1e-6);
  b.in.scale = 0.05;
  EXPECT_NEAR(b.rest(1000).force.x(), -1.0, 1e-6) << "a hand that rests feels no change";
  EXPECT_NEAR(b.move({0.03, 0.0, 0.0}, 0.02).force.x(), -2.0, 1e-9);
}

TEST(Resistance, HasNoHomeSpringInPositionModeUnlessAskedFor) {
  for (const bool home : {false, true}) {
    Bench b({.friction_n = 0.0, .friction_nm = 0.0, .home_spring = home});
    b.rest(1);
    b.move({0.02, 0.0, 0.0}, 0.05);
    b.turn({0.0, 0.2, 0.0}, 0.5);
    const Wrench F = b.rest(1000);
    EXPECT_NEAR(F.force.x(), home ? -60.0 * 0.02 : 0.0, 1e-6);
    EXPECT_NEAR(F.moment.y(), home ? -0.45837 * 0.2 : 0.0, 1e-6);
    EXPECT_NEAR(b.resistance.rotation_energy_j(), home ? 0.5 * 0.45837 * 0.04 : 0.0, 1e-6);
  }
}

/// A rotational spring pulls along the rotation vector, whatever the way that led there.
TEST(Resistance, ItsRotationalSpringForgetsTheWay) {
  Bench b;
  b.in.mode = MotionMode::kRate;
  b.rest(1);
  for (const Vector3& r : {Vector3(0.3, 0.0, 0.0), Vector3(0.3, 0.4, 0.0), Vector3(-0.1, 0.4, 0.5)}) {
    const Quaternion from = b.in.handle.q_MH, way = exp_rotation(r) * from.conjugate();
    for (int i = 1; i <= 300; ++i) {
      b.in.handle.q_MH = exp_rotation(log_rotation(way) * (i / 300.0)) * from;
      b.rest(1);
    }
    const Vector3 M = b.rest(1).moment;
    EXPECT_LE((M + 0.45837 * r).norm(), 1e-9);
  }
}

TEST(Resistance, BeginsWithoutForceWhereverTheHandleIs) {
  Bench b({.home_spring = true});
  b.in.handle.p_MH = {0.03, 0.02, -0.01};
  b.in.handle.q_MH = exp_rotation({0.3, 0.0, 0.1});
  b.resistance.reset(b.in.handle);
  const Wrench F = b.rest(1);
  EXPECT_LE(F.force.norm(), 1e-12);
  EXPECT_LE(F.moment.norm(), 1e-12);
}

}  // namespace
}  // namespace longreach::resistance_test
