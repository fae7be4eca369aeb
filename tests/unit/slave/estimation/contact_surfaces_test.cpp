// Several surfaces at once and after each other: which there are, what each bears, when they are forgotten.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "common/core/random.hpp"
#include "slave/estimation/contact.hpp"
#include "tests/unit/slave/estimation/contact_bench.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::contact_surfaces_test {
namespace {

using contact_bench::Bench;
using contact_bench::kDt;
using contact_bench::Plane;

const Vector3 kX = Vector3::UnitX(), kY = Vector3::UnitY();

void expect_surface(const Bench& b, const Plane& plane, bool pressed) {
  const ReportedSurface s = b.facing(plane.normal);
  EXPECT_GT(s.touch, 0U);
  EXPECT_EQ(s.pressed, pressed);
  EXPECT_NEAR(s.stiffness, plane.stiffness_n_per_m, 0.05 * plane.stiffness_n_per_m);
  const Vector3 below = b.p_m + (plane.place_m - plane.normal.dot(b.p_m)) * plane.normal;
  EXPECT_NEAR(s.offset, s.normal.dot(below), 2e-4);
  EXPECT_NEAR(s.foot, 0.0, 1.5e-4);  // n is not known to be 1
  EXPECT_NEAR(s.offset - s.foot, s.normal.dot(below), 2e-4);
}

TEST(Surfaces, BothSidesOfASlotAreRememberedWithTheirSense) {
  const Plane front{-kX, -0.01, 1000.0}, back{kX, -0.01, 2000.0};
  Bench b({front, back});
  b.go(0.014 * kX);
  expect_surface(b, front, true);
  b.go(-0.012 * kX);
  EXPECT_EQ(b.there(), 2);
  expect_surface(b, front, false);
  expect_surface(b, back, true);
  b.go(0.012 * kX);
  expect_surface(b, front, true);
  expect_surface(b, back, false);
}

TEST(Surfaces, ACornerIsTwo) {
  const Plane front{-kX, -0.01, 1000.0}, side{-kY, -0.01, 3000.0};
  Bench b({front, side});
  b.go({0.014, 0.0, 0.0});
  b.go({0.014, 0.012, 0.0});  // along the one into the other
  EXPECT_EQ(b.pressed(), 2);
  b.go({0.0125, 0.0115, 0.0}, 1e-3);
  b.go({0.0135, 0.0122, 0.0}, 1e-3);
  expect_surface(b, front, true);
  expect_surface(b, side, true);
  b.go({0.008, 0.012, 0.0});
  expect_surface(b, front, false);
  expect_surface(b, side, true);
}

// The edge of a step that the tool rides over pushes against its way at first.
TEST(Surfaces, AnEdgeThatTurnsIntoAWallIsOne) {
  Bench b({{-kX, -0.01, 1000.0}});
  const auto wall = b.force;
  b.force = [&](const Vector3& p) {
    const double over_m = p.y() - 0.005;
    if (over_m < 0.0) return Vector3(wall(p));
    const double angle = test::kPi / 3.0 * std::max(0.0, 1.0 - over_m / 0.005);
    return Vector3(-(4.0 + 1000.0 * std::min(over_m, 0.01)) * Vector3(std::cos(angle), std::sin(angle), 0.0));
  };
  b.go({0.014, 0.0, 0.0});
  b.go({0.014, 0.015, 0.0});
  EXPECT_EQ(b.there(), 1);
  EXPECT_GT(b.facing(-kX).touch, 0U);
}

TEST(Surfaces, AnObtuseCornerIsTwo) {
  const Vector3 oblique = Vector3(-0.5, -std::sqrt(0.75), 0.0);
  const Plane front{-kX, -0.01, 1000.0}, side{oblique, -0.012, 1500.0};
  Bench b({front, side});
  b.go({0.014, 0.0, 0.0});
  b.go({0.0135, 0.010, 0.0});
  b.go({0.014, 0.0105, 0.0}, 1e-3);
  EXPECT_EQ(b.pressed(), 2);
  EXPECT_GT(b.facing(-kX).touch, 0U);
}

TEST(Surfaces, ABallIsOne) {
  constexpr double kRadius_m = 0.05;
  Bench b({});
  b.force = [](const Vector3& p) {
    const Vector3 from = p - Vector3(0.06, 0.0, 0.0);
    return Vector3(1000.0 * std::max(0.0, kRadius_m - from.norm()) * from.normalized());
  };
  b.go({0.013, 0.0, 0.0});
  for (int i = 0; i < 4; ++i) {
    const double to = i % 2 == 0 ? 0.02 : -0.02;
    const double depth = 0.047;
    b.go({0.06 - std::sqrt(depth * depth - to * to), to, 0.0}, 0.01);
    EXPECT_EQ(b.there(), 1) << i;
  }
}

TEST(Surfaces, FrictionIsNone) {
  Bench b({{-kX, -0.01, 1000.0}});
  const auto wall = b.force;
  double way = 0.0;
  Vector3 last = Vector3::Zero();
  b.force = [&](const Vector3& p) {
    Vector3 f = wall(p);
    way += p.y() - last.y();
    last = p;
    const double most = 0.5 * f.norm();
    way = std::clamp(way, -most / 2e4, most / 2e4);  // sticks to 20 N/mm, then slides
    f.y() -= 2e4 * way;
    return f;
  };
  b.go({0.014, 0.0, 0.0});
  for (const double y : {0.01, -0.01, 0.02}) {
    b.go({0.014, y, 0.0});
    EXPECT_EQ(b.there(), 1) << y;
  }
}

TEST(Surfaces, FreeSpaceDisprovesASurfaceAndOnlyThat) {
  Bench b({{-kX, -0.01, 1000.0}});
  b.go(0.014 * kX);
  b.go(0.005 * kX);
  EXPECT_EQ(b.there(), 1);
  b.planes.clear();  // twice the threshold
  const double proof_m = 2.0 * configured_touch_n({}) / 1000.0;
  b.go((0.01 + 0.8 * proof_m) * kX);
  EXPECT_EQ(b.there(), 1);
  b.go((0.01 + 1.3 * proof_m) * kX);
  EXPECT_EQ(b.there(), 0);
}

// Damping and a lag of the force misplace a surface by a part of the depth that was pressed.
TEST(Surfaces, OneThatIsALittleFartherIsMovedBackAndOneFarBehindGoes) {
  for (const auto& [farther_m, again] : {std::pair{2e-4, false}, {2e-4, true}, {1e-3, false}}) {
    Bench b({{-kX, -0.01, 5000.0}});
    b.go(0.014 * kX);
    for (const double to_m : {0.005, again ? 0.0103 : 0.005, 0.005}) b.go(to_m * kX);  // lightly
    const std::uint32_t first = b.facing(-kX).touch;
    b.planes[0].place_m -= farther_m;
    const bool moved = farther_m < 0.1 * 0.004;
    b.go((0.01 + farther_m) * kX, 2e-3);
    EXPECT_EQ(b.there(), moved ? 1 : 0) << farther_m;
    if (!moved) continue;
    EXPECT_NEAR(b.facing(-kX).offset, -0.01 - farther_m, 1e-4) << "without force in free space";
    b.go((0.01 + farther_m + 2e-4) * kX, 2e-3);
    EXPECT_EQ(b.facing(-kX).touch, first + 1);
    EXPECT_NEAR(b.facing(-kX).stiffness, 5000.0, 250.0);
  }
}

// At rest the mean of the force decides, and less than the touch threshold is enough.
TEST(Surfaces, ARestInFreeSpaceEndsEvenALightForce) {
  for (const bool free : {true, false}) {
    Bench b({{-kX, -0.01, 1000.0}});
    for (const double to_m : {0.014, 0.005}) b.go(to_m * kX);
    if (free) b.planes.clear();
    b.go(0.0102 * kX), b.rest(0.2);  // 0.2 N
    EXPECT_NEAR(b.facing(-kX).offset, -0.01, 5e-5) << "too early to know";
    b.rest(0.3);
    EXPECT_NEAR(b.facing(-kX).offset, free ? -0.0102 : -0.01, 5e-5) << free;
  }
}

// Faster than the filtered force follows.
TEST(Surfaces, AKnownWallIsMetAgainHoweverFast) {
  Bench b({{-kX, -0.01, 7000.0}});
  b.go(0.0115 * kX);
  b.go(Vector3::Zero());
  ASSERT_EQ(b.there(), 1);
  const std::uint32_t first = b.facing(-kX).touch;
  b.go(0.0115 * kX, 0.25);
  EXPECT_EQ(b.facing(-kX).touch, first + 1);
  EXPECT_NEAR(b.facing(-kX).stiffness, 7000.0, 350.0);
}

TEST(Surfaces, ATouchElsewhereOfTheSameDirectionReplacesIt) {
  Bench b({{-kX, -0.01, 1000.0}});
  b.go(0.014 * kX);
  b.go(Vector3::Zero());
  b.planes = {{-kX, -0.005, 500.0}};  // a step nearer
  b.go(0.011 * kX, 2e-3);
  EXPECT_EQ(b.there(), 1);
  expect_surface(b, b.planes[0], true);
}

TEST(Surfaces, WhatIsPressedFromTheStartIsIdentifiedOnceTheToolMoves) {
  Bench b({{-kX, 0.003, 1000.0}});  // 3 mm deep
  b.rest(0.5);
  EXPECT_EQ(b.pressed(), 1);
  b.go(0.001 * kX);
  b.go(Vector3::Zero());
  expect_surface(b, b.planes[0], true);
}

TEST(Surfaces, ACurvedLawIsToldByItsTangentFromTheFootOn) {
  Bench b({});
  b.force = [](const Vector3& p) {  // 3 N at 3.16 mm
    const double depth = std::max(0.0, p.x() - 0.01);
    return Vector3(-3e5 * depth * depth, 0.0, 0.0);
  };
  EstimatorConfig config;
  config.exponent = 2.0;
  b.contact = SlaveContact(SensingConfig{}, config);
  b.go(0.0131 * kX);
  b.go(0.0125 * kX);
  b.go(0.0131 * kX);
  const ReportedSurface s = b.facing(-kX);
  const double depth = b.contact.foremost().reported().depth_m();
  EXPECT_NEAR(s.stiffness, 6e5 * depth, 0.05 * 6e5 * depth);
  EXPECT_NEAR(s.foot, 0.5 * depth, 0.05 * depth);
}

// A wall that came has gone again, and the tool is pressed into the one behind it.
TEST(ContactSurfaces, OppositeForceIsNewSurfaceAndGuarded) {
  SlaveContact contact(SensingConfig{}, EstimatorConfig{});
  const auto press = [&contact](const Vector3& force_n, int ticks) {
    for (int i = 0; i < ticks; ++i) contact.step({Vector3::Zero(), Vector3::Zero(), force_n, 0.0, 1.0, 1e-3});
  };
  press(Vector3(60, -180, 40), 2000);
  EXPECT_TRUE(contact.force().elsewhere.isZero(0.0));
  const std::uint32_t touch = contact.touch();
  press(Vector3(-20, 0, 0), 100);
  EXPECT_TRUE(contact.in_contact());
  EXPECT_EQ(contact.touch(), touch + 1);
  EXPECT_GT(contact.foremost().normal().dot(-Vector3::UnitX()), 0.95);
  EXPECT_LT(contact.force().elsewhere.x(), -0.99);
  EXPECT_NEAR(contact.force().elsewhere_n, 20.0, 0.1);
  press(Vector3(-20, 0, 0), 4000);
  EXPECT_TRUE(contact.force().elsewhere.isZero(0.0)) << "its normal is that of the contact now";
  EXPECT_NEAR(contact.force().force_n, 20.0, 0.5);
}

// A catch yields while the tool moves back a little: the force then falls as on a very stiff surface, which the
// tool would never be able to disprove because the hand feels it first.
TEST(ContactSurfaces, ASurfaceThatGaveWayIsForgotten) {
  for (const double stiffness : {500.0, 3000.0}) {
    for (const double seconds : {0.03, 0.1}) {
      const auto pressed = [stiffness](const Vector3& p) {
        return Vector3(-stiffness * std::max(0.0, p.x() - 0.002), 0, 0);
      };
      Bench b({});
      b.force = pressed;
      b.go({0.002 + 8.0 / stiffness, 0, 0});
      b.go({0.002 + 12.0 / stiffness, 0, 0}, 1e-3);
      ASSERT_EQ(b.pressed(), 1);
      for (double left = 1.0; left > 0.0; left -= kDt / seconds) {
        b.force = [&](const Vector3& p) { return Vector3(left * pressed(p)); };
        b.go(b.p_m - Vector3(2e-6, 0, 0), 2e-3);
      }
      b.force = [](const Vector3&) { return Vector3(Vector3::Zero()); };
      b.go(b.p_m - Vector3(1e-3, 0, 0), 2e-3);
      EXPECT_FALSE(b.contact.in_contact());
      EXPECT_EQ(b.there(), 0) << stiffness << " N/m, " << seconds << " s";
    }
    Bench stays({{-kX, -0.002, stiffness}});
    stays.go({0.002 + 12.0 / stiffness, 0, 0});
    stays.go({0, 0, 0});
    EXPECT_EQ(stays.there(), 1) << "the control: the tool went away";
  }
}

/// What a sensor that was never zeroed says at the start may be bias, or a contact.
struct Start {
  Start(double bias, double wall) : bias_n(bias), wall_m(wall) {}
  void go(double to_m, double speed = 2e-3) {
    while (std::abs(to_m - x_m) > 1e-12) {
      const double step = std::clamp(to_m - x_m, -speed * kDt, speed * kDt);
      x_m += step;
      feel(step / kDt);
    }
  }
  void rest(double seconds) {
    for (double t = 0.0; t < seconds; t += kDt) feel(0.0);
  }
  void feel(double v) {
    const double force_n = -bias_n - 1000.0 * std::max(0.0, x_m - wall_m);
    if (!possible_n) possible_n = force_n;
    const Vector3 noise(0.05 * random.normal(), 0.05 * random.normal(), 0.05 * random.normal());
    contact.step({.p_WE = Vector3(x_m, 0, 0),
                  .v_WE = Vector3(v, 0, 0),
                  .force_n = Vector3(force_n, 0, 0) + noise,
                  .dt = kDt,
                  .bias_n = Vector3(*possible_n, 0, 0)});
  }
  double bias_n, wall_m;
  double x_m = 0.0;
  std::optional<double> possible_n{};
  Random random{1};
  SlaveContact contact{SensingConfig{}, EstimatorConfig{}};
};

TEST(ContactSurfaces, AForceAtTheStartThatFollowsTheMotionIsAContact) {
  Start start(0.0, -0.002);  // 2 N
  start.rest(1.0);
  EXPECT_FALSE(start.contact.in_contact()) << "it may be bias";
  start.go(1e-3);
  start.rest(0.5);
  ASSERT_TRUE(start.contact.in_contact());
  EXPECT_NEAR(start.contact.foremost().reported().stiffness_n_per_m(), 1000.0, 100.0);
  start.go(-1e-3);
  EXPECT_TRUE(start.contact.in_contact()) << "also where it is as at the start";
  start.go(-3e-3);
  EXPECT_FALSE(start.contact.in_contact());
}

TEST(ContactSurfaces, AForceAtTheStartThatStaysIsBias) {
  Start start(2.0, 0.015);
  start.rest(1.0);
  start.go(0.015);
  EXPECT_FALSE(start.contact.in_contact());
  start.go(0.017);
  start.rest(0.5);
  EXPECT_TRUE(start.contact.in_contact());
  start.go(0.012);
  start.rest(0.5);
  EXPECT_FALSE(start.contact.in_contact()) << "it contradicts the law of the wall, so it is bias still";
}

// After a fault of the sensor, what was supposed from its force is forgotten, too. The control is without a fault.
TEST(ContactSurfaces, ASupposedSurfaceOfAFaultySensorIsForgotten) {
  for (const bool fault : {false, true}) {
    Start start(0.0, -0.002);
    for (int i = 0; i < 5; ++i) {
      start.go(0.2e-3);
      start.go(0.0);
    }
    if (fault) start.contact.forget_surfaces();
    while (!start.contact.in_contact()) start.go(start.x_m + 1e-5);
    EXPECT_EQ(start.contact.foremost().reported().stiffness_n_per_m() > 0.0, !fault);
  }
}

}  // namespace
}  // namespace longreach::contact_surfaces_test
