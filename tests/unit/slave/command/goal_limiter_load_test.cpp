// The force guard while the gripper holds a load, by the equations of slave/command/contact_guard.hpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "slave/command/goal_limiter.hpp"

namespace longreach::goal_limiter_load_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kGuard_n = 20.0, kStiffest_n_per_m = 2e4, kAcceleration = 1.25, kSpeed = 0.25;

const Vector3 kOut = -Vector3::UnitX();  // of the contact

/// At rest at zero, then in a contact that does not change.
struct Touching {
  GoalLimiter limiter{CommandConfig{}, Vector3::Zero()};
  ContactForce contact{.in_contact = true, .reaction = kOut};
  LimiterOutput out{};

  Touching(double force_n, double load_kg) {
    contact.force_n = force_n;
    contact.load_kg = load_kg;
    limiter.reset({});
  }
  Vector3 go_to(const Vector3& goal_m, int ticks) {
    for (int i = 0; i < ticks; ++i)
      out = limiter.step({Pose{goal_m, Quaternion::Identity()}, contact, kDt, false});
    return limiter.velocity().linear;
  }
};

TEST(LoadGuard, BoundsTheSpeedByTheMomentumOfALoad) {
  for (const double load_kg : {0.0, 1.0, 30.0}) {
    for (const double force_n : {0.0, 15.0, 19.9}) {
      Touching t(force_n, load_kg);
      const double left_m = (kGuard_n - force_n) / kStiffest_n_per_m;
      double allowed = std::min(std::sqrt(2.0 * kAcceleration * left_m), kSpeed);
      // The kinetic energy of the load is at most that of the stiffest surface over the remaining distance.
      if (load_kg > 0.0) allowed = std::min(allowed, left_m * std::sqrt(kStiffest_n_per_m / load_kg));
      EXPECT_NEAR(t.go_to(Vector3(2, 0, 0), 300).x(), allowed, 1e-12) << load_kg << ' ' << force_n;
      Touching across(force_n, load_kg);
      across.contact.grows = Vector3::UnitY();
      EXPECT_NEAR(across.go_to(Vector3(0, 2, 0), 300).y(), allowed, 1e-12) << load_kg << ' ' << force_n;
    }
  }
}

/// Returns the maximum force of a wall of the greatest stiffness on which a load on a bond is pressed. The
/// sensor is late, and the inertial force of the load is subtracted from its force.
double wall_force_max_n(double load_kg, bool known) {
  constexpr double kBond_n_per_m = 2e4, kDamping_n_s_per_m = 1500.0, kBond_s = 0.01;
  constexpr std::size_t kLate = 16;
  constexpr int kParts = 20;
  GoalLimiter limiter{CommandConfig{}, Vector3::Zero()};
  limiter.reset({});
  std::array<double, kLate> late_n{};
  double tool_m = 0.0, tool_speed = 0.0, slow_m_per_s2 = 0.0, place_m = 0.0, speed = 0.0, most_n = 0.0;
  for (std::size_t i = 0; i < 4000; ++i) {
    ContactForce contact{.in_contact = true, .reaction = kOut, .force_n = late_n[i % kLate]};
    contact.load_kg = known ? load_kg : 0.0;
    const Pose goal{Vector3(0.01, 0, 0), Quaternion::Identity()};
    const double before_m = std::exchange(tool_m, limiter.step({goal, contact, kDt, false}).X_WE.p.x());
    const double before = std::exchange(tool_speed, (tool_m - before_m) / kDt);
    slow_m_per_s2 += kDt / kBond_s * ((tool_speed - before) / kDt - slow_m_per_s2);
    double bond_n = 0.0;
    for (int part = 0; part < kParts; ++part) {
      bond_n = kBond_n_per_m * (tool_m - place_m) + kDamping_n_s_per_m * (tool_speed - speed);
      const double wall_n = kStiffest_n_per_m * std::max(0.0, place_m);
      speed += kDt / kParts * (bond_n - wall_n) / load_kg;
      place_m += kDt / kParts * speed;
      most_n = std::max(most_n, wall_n);
    }
    late_n[i % kLate] = bond_n - load_kg * slow_m_per_s2;
  }
  return most_n;
}

TEST(LoadGuard, ALoadThatIsPressedOnAWallIsStoppedAtTheGuard) {
  for (const double load_kg : {10.0, 30.0}) {
    EXPECT_LT(wall_force_max_n(load_kg, true), 1.35 * kGuard_n) << load_kg;
    EXPECT_GT(wall_force_max_n(load_kg, false), 1.6 * kGuard_n) << "the control: its mass is not used";
  }
}

TEST(LoadGuard, ALoadLeavesTheNeighbourhoodOfAContactSlowly) {
  constexpr double kLoad_kg = 30.0;
  const double stopped = kGuard_n / std::sqrt(kStiffest_n_per_m * kLoad_kg);
  Touching t(5.0, kLoad_kg);
  t.go_to(Vector3::Zero(), 10);
  t.contact.in_contact = false;
  double before_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double speed = -t.go_to(Vector3(-1, 0, 0), 1).x(), way_m = -t.out.X_WE.p.x();
    EXPECT_LE(speed, std::min(stopped * (1.0 + before_m / 0.02), kSpeed) + 1e-12) << way_m;
    before_m = way_m;
  }
  EXPECT_GT(before_m, 0.2);
  Touching empty(5.0, 0.0);
  empty.go_to(Vector3::Zero(), 10);
  empty.contact.in_contact = false;
  EXPECT_GT(-empty.go_to(Vector3(-1, 0, 0), 250).x(), 0.2) << "the control: no load is held";
}

}  // namespace
}  // namespace longreach::goal_limiter_load_test
