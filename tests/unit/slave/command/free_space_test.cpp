#include "slave/command/free_space.hpp"

#include <gtest/gtest.h>

namespace longreach::free_space_test {
namespace {

constexpr double kDt = 1e-3;

/// Moves along x from 0 to 0.1 m, at 0.1 m/s.
FreeSpace passed_along_x() {
  FreeSpace space;
  for (int i = 0; i <= 1000; ++i) space.step({1e-4 * i, 0.0, 0.0}, true, kDt);
  return space;
}

TEST(FreeSpace, IsUnknownAtTheStart) {
  const FreeSpace space;
  EXPECT_EQ(space.free_ahead_m(Vector3::Zero(), Vector3::UnitX(), 0.03), 0.0);
}

TEST(FreeSpace, EndsWhereTheToolHasBeen) {
  const FreeSpace space = passed_along_x();
  EXPECT_EQ(space.free_ahead_m({0.02, 0.0, 0.0}, Vector3::UnitX(), 0.03), 0.03);
  EXPECT_EQ(space.free_ahead_m({0.08, 0.0, 0.0}, -Vector3::UnitX(), 0.03), 0.03);
  for (double x = 0.075; x < 0.085; x += 1e-4) {
    const double ahead_m = space.free_ahead_m({x, 0.0, 0.0}, Vector3::UnitX(), 0.03);
    EXPECT_LE(x + ahead_m, 0.1 + 1e-9) << x;
    EXPECT_GE(x + ahead_m, 0.1 - 13.5e-3) << x;
  }
}

TEST(FreeSpace, HasAMarginBesideThePathButNotAcrossIt) {
  const FreeSpace space = passed_along_x();
  EXPECT_EQ(space.free_ahead_m({0.02, 0.004, -0.004}, Vector3::UnitX(), 0.03), 0.03);
  EXPECT_EQ(space.free_ahead_m({0.02, 0.011, 0.0}, Vector3::UnitX(), 0.03), 0.0);
  EXPECT_EQ(space.free_ahead_m({0.05, 0.0, 0.0}, Vector3::UnitY(), 0.03), 0.0);
}

TEST(FreeSpace, IsForgottenAfterTenSecondsAndAtAnEngagement) {
  FreeSpace space = passed_along_x();
  for (int i = 0; i < 9700; ++i) space.step({0.1, 0.0, 0.0}, true, kDt);
  EXPECT_GT(space.free_ahead_m({0.095, 0.0, 0.0}, -Vector3::UnitX(), 0.03), 0.0);
  EXPECT_EQ(space.free_ahead_m({0.02, 0.0, 0.0}, Vector3::UnitX(), 0.03), 0.0);
  space.forget();
  EXPECT_EQ(space.free_ahead_m({0.095, 0.0, 0.0}, -Vector3::UnitX(), 0.03), 0.0);
  space.step({0.1, 0.0, 0.0}, true, kDt);
  EXPECT_EQ(space.free_ahead_m({0.05, 0.0, 0.0}, Vector3::UnitX(), 0.03), 0.0);
}

TEST(FreeSpace, IsNotFreeWhileTheToolTouches) {
  FreeSpace space;
  for (int i = 0; i <= 1000; ++i) space.step({1e-4 * i, 0.0, 0.0}, false, kDt);
  EXPECT_EQ(space.free_ahead_m({0.02, 0.0, 0.0}, Vector3::UnitX(), 0.03), 0.0);
}

TEST(FreeSpace, AcceptsPositionsOfAnySize) {
  FreeSpace space;
  for (const double x : {1e300, -1e300, 1e9, 0.0}) {
    space.step({x, -x, x}, true, kDt);
    EXPECT_GE(space.free_ahead_m({x, -x, x}, Vector3::UnitX(), 0.03), 0.0);
  }
}

}  // namespace
}  // namespace longreach::free_space_test
