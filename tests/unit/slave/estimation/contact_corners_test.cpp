// Corners, and known walls that the tool reaches at once.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/unit/slave/estimation/contact_bench.hpp"

namespace longreach::contact_corners_test {
namespace {

using contact_bench::Bench;
using contact_bench::Plane;

const Vector3 kX = Vector3::UnitX();

/// Walls of 0.8 and 1.2 N/mm, 10 mm from the start, with this angle between them.
struct Corner {
  explicit Corner(double degrees)
      : first(kX), second(-std::cos(degrees / 57.29578), std::sin(degrees / 57.29578), 0.0) {}
  [[nodiscard]] std::vector<Plane> planes() const {
    return {{-first, -0.01, 800.0}, {-second, -0.01, 1200.0}};
  }
  [[nodiscard]] Vector3 behind(double first_m, double second_m) const {
    Matrix3 normals = Matrix3::Identity();
    normals.row(0) = first.transpose();
    normals.row(1) = second.transpose();
    return normals.partialPivLu().solve(Vector3(0.01 + first_m, 0.01 + second_m, 0.0));
  }
  Vector3 first, second;
};

TEST(Surfaces, ACornerKeepsItsWallsWhateverItsAngle) {
  for (const double degrees : {60.0, 90.0, 120.0}) {
    const Corner corner(degrees);
    Bench b(corner.planes());
    b.go(corner.behind(0.004, -0.01));
    b.rest(1.0);
    b.go(corner.behind(0.004, 0.003));
    b.rest(2.0);
    b.go(Vector3::Zero());
    b.go(corner.behind(0.004, 0.003), 2e-2);  // both at once
    b.rest(2.0);
    EXPECT_EQ(b.pressed(), 2) << degrees;
    EXPECT_NEAR(b.facing(-corner.first).stiffness, 800.0, 120.0) << degrees;
    EXPECT_NEAR(b.facing(-corner.second).stiffness, 1200.0, 180.0) << degrees;
    EXPECT_GT(b.facing(-corner.first).normal.dot(-corner.first), std::cos(0.06)) << degrees;
    EXPECT_GT(b.facing(-corner.second).normal.dot(-corner.second), std::cos(0.06)) << degrees;
  }
}

TEST(Surfaces, KnownWallsBearFromTheFirstMoment) {
  const Corner corner(90.0);
  Bench b(corner.planes());
  for (const Vector3& place : {corner.behind(0.004, -0.01), corner.behind(-0.01, 0.004)}) {
    b.go(place);
    b.rest(1.0);
    b.go(Vector3::Zero());
  }
  b.go(corner.behind(0.001, 0.001), 2e-2);
  EXPECT_EQ(b.pressed(), 2);
  EXPECT_NEAR(b.facing(-corner.first).stiffness, 800.0, 40.0);
  EXPECT_NEAR(b.facing(-corner.second).stiffness, 1200.0, 60.0);
}

TEST(Surfaces, TheWallsOfAnObtuseCornerAreBothRemembered) {
  const Corner corner(130.0);
  Bench b(corner.planes());
  for (const Vector3& place : {corner.behind(0.004, -0.01), corner.behind(-0.01, 0.004)}) {
    b.go(place);
    b.rest(1.0);
    b.go(Vector3::Zero());
  }
  EXPECT_EQ(b.there(), 2);
}

TEST(Surfaces, AWallThatIsGoneIsForgottenBesideOneThatIsPressed) {
  const Corner corner(120.0);
  Bench b(corner.planes());
  for (const Vector3& place : {corner.behind(0.004, -0.01), corner.behind(-0.01, 0.004)}) {
    b.go(place);
    b.rest(1.0);
    b.go(Vector3::Zero());
  }
  ASSERT_EQ(b.there(), 2);
  b.planes.erase(b.planes.begin());
  b.go(corner.behind(-0.01, 0.004));
  b.go(corner.behind(0.004, 0.004));
  b.rest(1.0);
  EXPECT_EQ(b.pressed(), 1);
  EXPECT_EQ(b.facing(-corner.first).touch, 0U);
}

TEST(Surfaces, AreDisprovedAtRestAlsoBeforeTheSensorIsZeroed) {
  Bench b({{-kX, -0.01, 1000.0}});
  b.bias_n = {0.0, 0.01, 0.0};
  b.go(0.012 * kX);
  b.rest(1.0);
  b.go(Vector3::Zero());
  ASSERT_EQ(b.there(), 1);
  b.planes.clear();   // it has gone
  b.go(0.0105 * kX);  // less deep than the touch threshold
  b.rest(1.0);
  EXPECT_EQ(b.there(), 0);
}

}  // namespace
}  // namespace longreach::contact_corners_test
