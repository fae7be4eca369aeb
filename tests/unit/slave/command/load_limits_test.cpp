// A load in the gripper limits the acceleration, by the equations of slave/command/load_limits.hpp.

#include "slave/command/load_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slave/command/motion.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::load_limits_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_as_configured(const CommandConfig& c, double load_kg) {
  const CommandConfig limits = with_load(c, load_kg);
  EXPECT_EQ(limits.acceleration_max_m_per_s2, c.acceleration_max_m_per_s2) << load_kg;
  EXPECT_EQ(limits.acceleration_max_rad_per_s2, c.acceleration_max_rad_per_s2) << load_kg;
}

TEST(LoadLimits, InertiaTakesThreeQuartersOfTheGuards) {
  const CommandConfig c;
  for (const double load_kg : {15.0, 30.0, 100.0, 300.0}) {
    const CommandConfig limits = with_load(c, load_kg);
    EXPECT_NEAR(load_kg * limits.acceleration_max_m_per_s2, 15.0, 1e-12) << load_kg;
    EXPECT_NEAR(load_kg * limits.acceleration_max_rad_per_s2, 3.75, 1e-12) << load_kg;
  }
  CommandConfig half = c;
  half.force_guard_n = 10.0;
  EXPECT_EQ(with_load(half, 30.0).acceleration_max_m_per_s2, 0.25);
}

TEST(LoadLimits, NoLoadAndALightLoadChangeNothing) {
  for (const double load_kg : {0.0, -1.0, 1e-300, std::numeric_limits<double>::denorm_min(), 1e-3, 1.8})
    expect_as_configured(CommandConfig{}, load_kg);
  CommandConfig gentle;
  gentle.acceleration_max_m_per_s2 = 0.01;
  gentle.acceleration_max_rad_per_s2 = 0.01;
  for (const double load_kg : {0.0, 1.0, 1e5, kInfinity, kNan}) expect_as_configured(gentle, load_kg);
}

TEST(LoadLimits, AHugeOrInvalidMassCanStillBeMoved) {
  for (const double load_kg : {1e5, 1e300, std::numeric_limits<double>::max(), kInfinity, kNan}) {
    const CommandConfig limits = with_load({}, load_kg);
    EXPECT_EQ(limits.acceleration_max_m_per_s2, kLoadAcceleration_min) << load_kg;
    EXPECT_EQ(limits.acceleration_max_rad_per_s2, kLoadAcceleration_min) << load_kg;
  }
}

TEST(LoadLimits, OnlyTheAccelerationsChange) {
  CommandConfig limits = with_load({}, 30.0);
  const CommandConfig c;
  EXPECT_EQ(limits.speed_max_m_per_s, c.speed_max_m_per_s);
  EXPECT_EQ(limits.speed_max_rad_per_s, c.speed_max_rad_per_s);
  EXPECT_EQ(limits.force_guard_n, c.force_guard_n);
  EXPECT_EQ(limits.moment_guard_nm, c.moment_guard_nm);
  EXPECT_EQ(limits.workspace_m, c.workspace_m);
  EXPECT_EQ(limits.give_way_m, c.give_way_m);
  EXPECT_EQ(limits.braking_max_m_per_s2, c.braking_max_m_per_s2);
}

/// Accelerations of the setpoint of an arm that follows a goal which jumps to and fro.
struct Driven {
  SlaveMotion motion{{}, test::space_arm()};
  Pose before = motion.X_WE();
  Twist velocity{};
  double m_per_s2 = 0.0, rad_per_s2 = 0.0;

  void step(const Pose& goal, double load_kg) {
    motion.step({.X_WE_goal = goal, .dt = kDt, .load_kg = load_kg});
    const Pose& now = motion.X_WE();
    const Twist v{log_rotation(now.q * before.q.conjugate()) / kDt, (now.p - before.p) / kDt};
    m_per_s2 = std::max(m_per_s2, (v.linear - velocity.linear).norm() / kDt);
    rad_per_s2 = std::max(rad_per_s2, (v.angular - velocity.angular).norm() / kDt);
    before = now;
    velocity = v;
  }
  void go(double load_kg, int ticks) {
    const Pose start = before;
    for (int i = 0; i < ticks; ++i) {
      const double sense = i / 700 % 2 == 0 ? 1.0 : -1.0;
      step(
          {start.p + sense * Vector3(0.1, 0.05, 0.0), exp_rotation(sense * Vector3(0.0, 0.1, 0.1)) * start.q},
          load_kg);
    }
  }
};

TEST(LoadLimits, TheSetpointKeepsToThem) {
  Driven empty, loaded;
  empty.go(0.0, 6000);
  EXPECT_GT(empty.m_per_s2, 1.2);
  EXPECT_GT(empty.rad_per_s2, 1.9);
  EXPECT_EQ(empty.motion.load_acceleration_m_per_s2(), 0.0);
  loaded.go(30.0, 6000);
  EXPECT_LE(loaded.m_per_s2, 0.505);
  EXPECT_LE(loaded.rad_per_s2, 0.126);
  EXPECT_EQ(loaded.motion.load_acceleration_m_per_s2(), 0.5) << "shown while it is in force";
  EXPECT_EQ(loaded.motion.load_acceleration_rad_per_s2(), 0.125);
  for (const Driven* arm : {&empty, &loaded}) EXPECT_EQ(arm->motion.limit_violations(), 0U);
}

TEST(LoadLimits, WithoutALoadTheSetpointIsTheSame) {
  Driven without, light;
  without.go(0.0, 4000);
  light.go(1.0, 4000);
  EXPECT_EQ(without.motion.joint_setpoint_rad(), light.motion.joint_setpoint_rad());
  EXPECT_EQ(light.motion.load_acceleration_m_per_s2(), 0.0);
  EXPECT_EQ(light.motion.load_acceleration_rad_per_s2(), 0.0);
}

TEST(LoadLimits, ALimitOfTheRotationAloneIsShown) {
  Driven arm;
  const Pose turned{arm.before.p, exp_rotation(Vector3(0.0, 0.1, 0.1)) * arm.before.q};
  for (int i = 0; i < 2000; ++i) arm.step(turned, 5.0);
  EXPECT_GT(arm.rad_per_s2, 0.7);
  EXPECT_LE(arm.rad_per_s2, 0.755);
  EXPECT_EQ(arm.motion.load_acceleration_m_per_s2(), 0.0) << "not reduced by this load";
  EXPECT_EQ(arm.motion.load_acceleration_rad_per_s2(), 0.75);
}

TEST(LoadLimits, TheyFollowTheGripper) {
  Driven arm;
  const Pose start = arm.before, there{start.p + Vector3(0.1, 0.05, 0.0), start.q};
  for (int i = 0; i < 2000; ++i) arm.step(there, 30.0);
  EXPECT_LE(arm.m_per_s2, 0.505);
  for (int i = 0; i < 300; ++i) arm.step(start, 0.0);
  EXPECT_GT(arm.m_per_s2, 1.2);
  EXPECT_EQ(arm.motion.load_acceleration_m_per_s2(), 0.0);
  arm.m_per_s2 = 0.0;
  for (int i = 0; i < 3000; ++i) arm.step(start, 30.0);  // closed while the tool moves
  EXPECT_LE(arm.m_per_s2, 1.2625) << "from tick to tick, the setpoint is a mean";
  EXPECT_EQ(arm.motion.load_acceleration_m_per_s2(), 0.5);
  EXPECT_LT((arm.before.p - start.p).norm(), 1e-3);
  EXPECT_EQ(arm.motion.limit_violations(), 0U);
}

TEST(LoadLimits, AnInvalidMassLeavesTheSetpointFinite) {
  Driven arm;
  arm.go(kNan, 3000);
  EXPECT_EQ(arm.motion.load_acceleration_m_per_s2(), kLoadAcceleration_min);
  EXPECT_LE(arm.m_per_s2, 0.0101);
  EXPECT_EQ(arm.motion.limit_violations(), 0U);
  EXPECT_TRUE(arm.motion.X_WE().p.allFinite());
}

}  // namespace
}  // namespace longreach::load_limits_test
