#include "slave/sensing/growth_watch.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/unit/slave/sensing/pressed_tool.hpp"

namespace longreach::growth_watch_test {
namespace {

using test::PressedTool;

const Vector3 kIn = Vector3::UnitX();
constexpr double kQuarter = 0.5 * std::numbers::pi;

TEST(GrowthWatch, SeesAWrongSignOrFrameBeforeTheForceIsHalfAGuard) {
  for (const double stiffness : {1e3, 5e3, 1e4}) {
    for (const Matrix3& sensor :
         {Matrix3(-Matrix3::Identity()), test::turned(kQuarter, Vector3::UnitZ()),
          test::turned(-kQuarter, Vector3::UnitY()), test::turned(2.1, Vector3::UnitZ())}) {
      PressedTool tool(stiffness);
      tool.sensor = sensor;
      while (!tool.suspected && tool.force_n() < 10.0) tool.go(0.01 * kIn);
      EXPECT_TRUE(tool.suspected) << stiffness << '\n' << sensor;
      EXPECT_GT(tool.watch.direction().dot(kIn), 0.99) << stiffness;
      EXPECT_NEAR(tool.watch.slope_n_per_m(), stiffness, 0.1 * stiffness);
      EXPECT_EQ(tool.watch.across(), std::abs((sensor * kIn).dot(kIn)) < 0.3);
    }
  }
}

TEST(GrowthWatch, WhatALoadMayCauseIsNoEvidence) {
  for (const double uncertainty_n : {0.0, 4.0}) {
    GrowthWatch watch(GrowthBounds{});
    bool suspected = false;
    for (int i = 0; i < 2000; ++i) {  // 2 N to and fro while the tool moves out at 1 mm/s
      const double force_n = 10.0 + 2.0 * std::sin(0.02 * i);
      watch.step({Vector3(-1e-6 * i, 0, 0), Vector3(-force_n, 0, 0), true, 1e-3, 0.0, uncertainty_n});
      suspected = suspected || !watch.direction().isZero(0.0);
    }
    EXPECT_EQ(suspected, uncertainty_n == 0.0);
  }
}

TEST(GrowthWatch, NeverFlagsWallWithinStiffnessBound) {
  for (const double stiffness : {100.0, 1e3, 5e3, 2e4}) {
    for (const double slant : {0.0, 0.6, 1.2, 1.5}) {  // of the way, from straight in
      for (const double noise : {0.0, 0.05}) {
        PressedTool tool(stiffness);
        tool.noise_n = noise;
        const Vector3 way(std::cos(slant), std::sin(slant), 0.0);
        const double speed = std::min(0.02, 20.0 / stiffness / std::cos(slant));
        for (int times = 0; times < 3; ++times) {  // in, along, rest, out but for a little
          tool.go(speed * way, 1.0);
          tool.go(0.02 * Vector3::UnitY(), 0.2);
          tool.go(Vector3::Zero(), 0.3);
          tool.go(-0.9 * speed * way, 1.0);
        }
        EXPECT_FALSE(tool.suspected) << stiffness << ' ' << slant << ' ' << noise;
      }
    }
  }
}

TEST(GrowthWatch, NeverAccusesAStifferWallThatIsPressedStraight) {
  for (const double stiffness : {1e5, 1e6}) {
    for (const double noise : {0.0, 0.05}) {
      PressedTool tool(stiffness);
      tool.noise_n = noise;
      const double speed = 30.0 / stiffness;
      for (int times = 0; times < 3; ++times) {
        tool.go(speed * kIn, 1.0);
        tool.go(Vector3::Zero(), 0.3);
        tool.go(-0.9 * speed * kIn, 1.0);
      }
      EXPECT_FALSE(tool.suspected) << stiffness << ' ' << noise;
    }
  }
}

TEST(GrowthWatch, AStifferWallThatIsSlidOnGrowsAcrossTheForce) {
  PressedTool tool(1e5);
  const Vector3 way(0.3, std::sqrt(1.0 - 0.3 * 0.3), 0.0);  // 3e4 N a metre of it
  while (!tool.suspected && tool.force_n() < 20.0) tool.go(0.005 * way);
  EXPECT_TRUE(tool.suspected);
  EXPECT_TRUE(tool.watch.across());
  EXPECT_NEAR(tool.watch.slope_n_per_m(), 3e4, 3e3);
}

// The force is late, and goes on to grow when the tool has turned back.
TEST(GrowthWatch, KnowsThatASlowSensorIsLate) {
  for (const double hz : {5.0, 20.0}) {
    PressedTool tool(5e3);
    tool.slow_sensor(hz);
    for (int times = 0; times < 3; ++times) {
      tool.go(0.02 * kIn, 0.2);
      tool.go(-0.018 * kIn, 0.2);
    }
    EXPECT_FALSE(tool.suspected) << hz;
  }
  PressedTool unaware(5e3);
  unaware.bandwidth_hz = 5.0;
  unaware.go(0.02 * kIn, 0.2);
  unaware.go(-0.018 * kIn, 0.2);
  EXPECT_TRUE(unaware.suspected) << "the case is one in which that matters";
}

TEST(GrowthWatch, WhatGrowsWhileTheToolRestsIsNotItsOwn) {
  PressedTool tool(0.0);
  tool.p_m = Vector3::Zero();
  for (int i = 0; i < 1300; ++i) tool.report((5.0 + 0.02 * i) * Vector3::UnitY());
  for (int i = 0; i < 1000; ++i) {
    tool.p_m += 1e-5 * kIn;
    tool.report(31.0 * Vector3::UnitY());
  }
  EXPECT_FALSE(tool.suspected);
}

TEST(GrowthWatch, WhatComesAtOnceIsNotByTheWayGone) {
  PressedTool tool(0.0);
  for (int i = 0; i < 50; ++i) {
    tool.p_m += 1e-6 * kIn;
    tool.report((i < 5 ? 1.0 : 16.0) * Vector3::UnitY());
  }
  EXPECT_FALSE(tool.suspected);
}

TEST(GrowthWatch, WhatGrewOnceIsForgottenWhereItDoesNotGrowAgain) {
  PressedTool tool(1e3);
  tool.sensor = -Matrix3::Identity();
  tool.go(0.01 * kIn, 0.5);
  ASSERT_TRUE(tool.suspected);
  Vector3 seen_m = tool.watch.place_m();
  double way_m = 0.0;
  for (int i = 0; i < 1000 && !tool.watch.direction().isZero(0.0); ++i) {
    tool.p_m += 1e-5 * kIn;
    tool.report(0.99 * tool.reported_n);
    if (tool.watch.age_s() == 0.0) seen_m = tool.watch.place_m();
    way_m = (tool.watch.place_m() - seen_m).norm();
  }
  EXPECT_NEAR(way_m, 1e-3, 2e-5);
  EXPECT_NEAR(tool.watch.age_s(), 0.1, 2e-3);
}

TEST(GrowthWatch, TheContactsEndEndsIt) {
  PressedTool tool(1e3);
  tool.sensor = -Matrix3::Identity();
  tool.go(0.01 * kIn, 0.5);
  ASSERT_FALSE(tool.watch.direction().isZero(0.0));
  tool.report(Vector3::Zero());
  EXPECT_TRUE(tool.watch.direction().isZero(0.0));
  tool.report(5.0 * kIn);  // the next contact begins anew, here
  EXPECT_EQ(tool.watch.size_n(), 5.0);
  EXPECT_EQ(tool.watch.place_m(), tool.p_m);
}

// A way back to where the force was less, long ago, is no growth of now.
TEST(GrowthWatch, PlacesOfHalfASecondAgoDoNotCount) {
  PressedTool tool(0.0);
  const auto creep = [&](double from_n, double to_n, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tool.p_m += 2.5e-8 * kIn;  // 25 um/s: one place a second
      tool.report((from_n + (to_n - from_n) * i / ticks) * Vector3::UnitY());
    }
  };
  creep(2.0, 2.15, 600);
  creep(2.15, 2.3, 600);
  creep(2.3, 2.45, 600);
  EXPECT_FALSE(tool.suspected) << "0.45 N, but never within half a second";
}

TEST(GrowthWatch, BeginsAnewWithAnEngagement) {
  PressedTool tool(2e3);
  tool.sensor = -Matrix3::Identity();
  while (!tool.suspected) tool.go(0.01 * kIn);
  tool.watch.reset();
  EXPECT_TRUE(tool.watch.direction().isZero(0.0));
  EXPECT_FALSE(tool.watch.in_contact());
  tool.suspected = false;
  tool.go(Vector3::Zero(), 0.5);
  EXPECT_FALSE(tool.suspected);
  tool.go(0.01 * kIn, 0.5);
  EXPECT_TRUE(tool.suspected);
}

TEST(GrowthWatch, WhatWasSeenDoesNotCountAsTheToolGivesWay) {
  PressedTool tool(2e3);
  tool.sensor = -Matrix3::Identity();
  while (!tool.suspected) tool.go(0.01 * kIn);
  tool.watch.forget();
  EXPECT_TRUE(tool.watch.direction().isZero(0.0));
  EXPECT_TRUE(tool.watch.in_contact());
}

}  // namespace
}  // namespace longreach::growth_watch_test
