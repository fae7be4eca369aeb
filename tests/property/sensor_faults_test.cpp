// Nothing that a force sensor says may move the robot further than the force answers to that, or let it press
// harder than the guard allows; and the cause is told.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "slave/config/guard_config.hpp"
#include "tests/property/lying_touch.hpp"

namespace longreach::test {
namespace {

constexpr double kUnanswered_m = 0.02;
constexpr double kBraking_m = 1e-3;  // servo and rounding

TEST(SensorFaults, AWrongSignOrFrameDoesNotPressHarderThanTheGuardAndIsTold) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  double worst = 0.0;
  for (const double wall_n_per_m : {1e3, 2e3, 5e3}) {
    for (const SensorLie& lie : {SensorLie{Lie::kSign}, SensorLie{Lie::kFrame, kQuarter, Vector3::UnitY()},
                                 SensorLie{Lie::kFrame, kQuarter, Vector3::UnitX()},
                                 SensorLie{Lie::kFrame, -kQuarter, Vector3::UnitX()}, SensorLie{Lie::kAxes},
                                 SensorLie{Lie::kFrame, 2.1, Vector3::UnitY()}}) {
      for (const double servo_hz : {3.0, 10.0}) {
        for (const double speed : {0.01, 0.05}) {
          LieCase c;
          c.lie = lie;
          c.guard.wall_n_per_m = wall_n_per_m;
          c.guard.servo_hz = servo_hz;
          c.guard.speed_m_per_s = speed;
          c.end_s = 0.03 / speed + 4.0;
          const LieRun run = lie_run(c);
          const auto what = std::string(name(lie.lie)) + ' ' + std::to_string(lie.amount);
          EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << what << ": " << c.guard;
          EXPECT_EQ(run.told, HoldCause::kSensorSign)
              << what << ": " << c.guard << " told " << static_cast<int>(run.told) << " at " << run.told_s;
          EXPECT_EQ(run.limit_violations, 0U) << what;
          worst = std::max(worst, run.peak_n / c.guard.guard_n);
        }
      }
    }
  }
  std::printf("wrong sign or frame: at most %.2f of the guard\n", worst);
}

TEST(SensorFaults, TheSameTouchesWithATrueSensorAreNotDoubted) {
  for (const double wall_n_per_m : {200.0, 1e3, 5e3, 2e4}) {
    for (const double servo_hz : {3.0, 10.0}) {
      for (const double silent_s : {1e9, 3.0}) {
        for (const double mass_kg : {0.0, 3.0}) {
          LieCase c;
          c.guard.wall_n_per_m = wall_n_per_m;
          c.guard.servo_hz = servo_hz;
          c.guard.mass_kg = mass_kg;
          c.behind_m = 0.1;
          c.silent_s = silent_s;
          const LieRun run = lie_run(c);
          EXPECT_EQ(run.told, HoldCause::kNone)
              << c.guard << " mass " << mass_kg << " told " << run.told_s << " silent " << silent_s;
          if (wall_n_per_m > 5e3) continue;  // more than the guard promises
          EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << c.guard;
        }
      }
    }
  }
}

/// The lie begins in free space, before or after the master has fallen silent.
TEST(SensorFaults, InAHoldALieMovesTheToolByNoMoreThanTheWayWithoutAnswer) {
  const Vector3 askew = Vector3(1, 1, 1).normalized();
  for (const SensorLie& lie :
       {SensorLie{Lie::kBias, 9.0 * std::sqrt(3.0), askew}, SensorLie{Lie::kStuck, 15.0},
        SensorLie{Lie::kStuck, 30.0, -Vector3::UnitX()}, SensorLie{Lie::kDrift, 5.0, askew},
        SensorLie{Lie::kDrift, -5.0, Vector3::UnitY()}}) {
    for (const double lie_s : {0.5, 2.0}) {
      LieCase c;
      c.lie = lie;
      c.lie_s = lie_s;
      c.behind_m = -kGuardWall_m;  // rests where it starts
      c.silent_s = 1.0;
      c.end_s = 12.0;
      const LieRun run = lie_run(c);
      EXPECT_LE(run.way_m(0.3), kUnanswered_m + kBraking_m) << name(lie.lie) << ' ' << lie_s;
      EXPECT_TRUE(of_the_sensor(run.told)) << name(lie.lie) << ' ' << lie_s;
      EXPECT_EQ(run.limit_violations, 0U);
    }
  }
}

TEST(SensorFaults, EngagedTheGuardDoesNotRetreatFurtherFromALie) {
  for (const SensorLie& lie : {SensorLie{Lie::kStuck, 30.0}, SensorLie{Lie::kBias, 30.0, Vector3::UnitY()},
                               SensorLie{Lie::kDrift, 10.0, -Vector3::UnitX()}}) {
    LieCase c;
    c.lie = lie;
    c.lie_s = 1.0;
    c.behind_m = -kGuardWall_m;
    c.end_s = 12.0;
    const LieRun run = lie_run(c);
    EXPECT_LE(run.way_m(0.9), kUnanswered_m + kBraking_m) << name(lie.lie);
    EXPECT_TRUE(of_the_sensor(run.told)) << name(lie.lie);
    EXPECT_NE(run.rows.back().state, SafetyState::kEngaged) << name(lie.lie);
  }
}

TEST(SensorFaults, OneSampleThatNoSensorCanMeanMovesNothingAndIsAFaultAtOnce) {
  for (const double value : {1e300, -1e300, 1e6, 200.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    for (const double behind_m : {-kGuardWall_m, 0.01}) {
      LieCase c;
      c.lie = {Lie::kSpike, value, Vector3(1, 1, 1).normalized()};
      c.lie_s = 3.0;
      c.behind_m = behind_m;
      c.end_s = 5.0;
      const LieRun run = lie_run(c);
      EXPECT_LE(run.way_m(2.999), 1e-4) << value;
      EXPECT_EQ(run.told, HoldCause::kSensorFault) << value;
      EXPECT_LE(run.told_s - c.lie_s, 2e-3) << value;
      EXPECT_EQ(run.rows.back().state, SafetyState::kFault) << value;
    }
  }
}

TEST(SensorFaults, AFrozenSensorIsToldWhereTheRobotGivesWay) {
  LieCase c;
  c.guard.wall_n_per_m = 1e3;
  c.lie = {Lie::kFrozen};
  c.lie_s = 2.0;
  c.silent_s = 2.0;
  const LieRun run = lie_run(c);
  EXPECT_EQ(run.told, HoldCause::kSensorFault);
  EXPECT_EQ(run.rows.back().state, SafetyState::kFault);
  EXPECT_LE(run.way_m(2.0), 0.005);
}

TEST(SensorFaults, ASensorAtTheEndOfItsRangeIsToldInATenthOfASecond) {
  LieCase c;
  c.lie = {Lie::kStuck, 40.0};
  c.lie_s = 1.0;
  c.behind_m = -kGuardWall_m;
  SlaveConfig config = lie_config(c);
  config.sensing.force_range_n = 40.0;
  const LieRun run = lie_run(c, config, [](int) { return false; });
  EXPECT_EQ(run.told, HoldCause::kSensorFault);
  EXPECT_LE(run.told_s - c.lie_s, 0.1);
}

TEST(SensorFaults, AWallThatComesIsGivenWayToAndIsNoFault) {
  for (const double give_way_m : {0.03, 0.2}) {
    for (const double coming : {0.003, 0.02, 0.05}) {
      for (const double wall_n_per_m : {200.0, 1e3, 5e3}) {
        LieCase c;
        c.guard.wall_n_per_m = wall_n_per_m;
        c.guard.guard_n = 20.0;
        c.coming_m_per_s = coming;
        c.behind_m = -kGuardWall_m;
        const double pressed_s = c.guard.guard_n / (wall_n_per_m * coming), way_s = 0.03 / coming;
        c.end_s = kGuardWall_m / coming + pressed_s + way_s + 1.0;
        SlaveConfig config = lie_config(c);
        config.command.give_way_m = give_way_m;
        const LieRun run = lie_run(c, config, [](int) { return false; });
        EXPECT_EQ(run.told, HoldCause::kNone) << coming << ' ' << wall_n_per_m;
        double peak_n = 0.0;
        HoldCause cause = HoldCause::kNone;
        for (const auto& row : run.rows) {
          if (row.cause == HoldCause::kWallComes) cause = row.cause;
          if (cause == HoldCause::kNone && row.tool_m.x() > -0.025) peak_n = std::max(peak_n, row.force_n);
        }
        EXPECT_EQ(cause, give_way_m < 0.1 ? HoldCause::kWallComes : HoldCause::kNone)
            << coming << ' ' << wall_n_per_m;
        EXPECT_LE(peak_n, kGuardOvershoot * c.guard.guard_n) << coming << ' ' << wall_n_per_m;
      }
    }
  }
}

/// A tool of 5 kg on a robot whose adapter stands still for 10 ms, four times a second.
LieRun stalling(double wall_behind_m) {
  LieCase c;
  c.guard.wall_n_per_m = 2e3;
  c.guard.speed_m_per_s = 0.01;
  c.behind_m = wall_behind_m;
  c.end_s = 5.0;
  SlaveConfig config = lie_config(c);
  config.sensing.tool.mass_kg = 5.0;
  return lie_run(c, config, [](int tick) { return tick > 250 && tick % 250 < 10; });
}

TEST(SensorFaults, AnAdapterThatStallsMakesNoTouchAndHidesNone) {
  constexpr double kInFront_m = -0.005;
  EXPECT_EQ(stalling(kInFront_m).touches, 0U);
  const LieRun pressed = stalling(0.02);
  EXPECT_GE(pressed.touches, 1U);
  EXPECT_LE(pressed.peak_n, kGuardOvershoot * 20.0);
}

/// The first zero takes 0.5 s: till then nobody engages; the contact that is met in the next is felt.
TEST(SensorFaults, ZeroingBlindsNobodyWhoIsEngaged) {
  for (const double zero_s : {0.5, 100.0}) {
    LieCase c;
    SlaveConfig config = lie_config(c);
    config.sensing.zero_s = zero_s;
    const LieRun run = lie_run(c, config, [](int) { return false; });
    EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << zero_s;
    for (const LieRow& row : run.rows) {
      if (row.t_s < std::min(zero_s, c.end_s)) {
        ASSERT_NE(row.state, SafetyState::kEngaged) << zero_s << ' ' << row.t_s;
      }
    }
    EXPECT_EQ(run.rows.back().state == SafetyState::kEngaged, zero_s < 1.0);
  }
}

}  // namespace
}  // namespace longreach::test
