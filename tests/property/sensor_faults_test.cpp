// Nothing that a force sensor says may move the robot further than the force answers to that, or let it press
// harder than the guard allows; and the cause is told.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "slave/config/guard_config.hpp"
#include "tests/property/faulty_touch.hpp"

namespace longreach::test::sensor_faults_test {
namespace {

constexpr double kUnanswered_m = 0.02;
constexpr double kBraking_m = 1e-3;  // servo and rounding

TEST(SensorFaults, WrongSignOrFrameStaysBelowGuardAndIsReported) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  double worst = 0.0;
  for (const double wall_n_per_m : {1e3, 2e3, 5e3}) {
    for (const SensorFault& sensor_fault :
         {SensorFault{SensorFaultKind::kSign},
          SensorFault{SensorFaultKind::kFrame, kQuarter, Vector3::UnitY()},
          SensorFault{SensorFaultKind::kFrame, kQuarter, Vector3::UnitX()},
          SensorFault{SensorFaultKind::kFrame, -kQuarter, Vector3::UnitX()},
          SensorFault{SensorFaultKind::kAxes}, SensorFault{SensorFaultKind::kFrame, 2.1, Vector3::UnitY()}}) {
      for (const double servo_hz : {3.0, 10.0}) {
        for (const double speed : {0.01, 0.05}) {
          SensorFaultCase c;
          c.sensor_fault = sensor_fault;
          c.guard.wall_n_per_m = wall_n_per_m;
          c.guard.servo_hz = servo_hz;
          c.guard.speed_m_per_s = speed;
          c.end_s = 0.03 / speed + 4.0;
          const SensorFaultRun run = sensor_fault_run(c);
          const auto what =
              std::string(name(sensor_fault.sensor_fault)) + ' ' + std::to_string(sensor_fault.amount);
          EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << what << ": " << c.guard;
          EXPECT_EQ(run.reported, HoldCause::kSensorSign)
              << what << ": " << c.guard << " told " << static_cast<int>(run.reported) << " at "
              << run.reported_s;
          EXPECT_EQ(run.limit_violations, 0U) << what;
          worst = std::max(worst, run.peak_n / c.guard.guard_n);
        }
      }
    }
  }
  std::printf("wrong sign or frame: at most %.2f of the guard\n", worst);
}

TEST(SensorFaults, CorrectSensorIsNeverSuspected) {
  for (const double wall_n_per_m : {200.0, 1e3, 5e3, 2e4}) {
    for (const double servo_hz : {3.0, 10.0}) {
      for (const double silent_s : {1e9, 3.0}) {
        for (const double mass_kg : {0.0, 3.0}) {
          SensorFaultCase c;
          c.guard.wall_n_per_m = wall_n_per_m;
          c.guard.servo_hz = servo_hz;
          c.guard.mass_kg = mass_kg;
          c.behind_m = 0.1;
          c.silent_s = silent_s;
          const SensorFaultRun run = sensor_fault_run(c);
          EXPECT_EQ(run.reported, HoldCause::kNone)
              << c.guard << " mass " << mass_kg << " told " << run.reported_s << " silent " << silent_s;
          if (wall_n_per_m > 5e3) continue;  // more than the guard promises
          EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << c.guard;
        }
      }
    }
  }
}

/// The lie begins in free space, before or after the master has fallen silent.
TEST(SensorFaults, SensorFaultInHoldMovesToolWithinRetreatBudget) {
  const Vector3 askew = Vector3(1, 1, 1).normalized();
  for (const SensorFault& sensor_fault : {SensorFault{SensorFaultKind::kBias, 9.0 * std::sqrt(3.0), askew},
                                          SensorFault{SensorFaultKind::kStuck, 15.0},
                                          SensorFault{SensorFaultKind::kStuck, 30.0, -Vector3::UnitX()},
                                          SensorFault{SensorFaultKind::kDrift, 5.0, askew},
                                          SensorFault{SensorFaultKind::kDrift, -5.0, Vector3::UnitY()}}) {
    for (const double fault_s : {0.5, 2.0}) {
      SensorFaultCase c;
      c.sensor_fault = sensor_fault;
      c.fault_s = fault_s;
      c.behind_m = -kGuardWall_m;  // rests where it starts
      c.silent_s = 1.0;
      c.end_s = 12.0;
      const SensorFaultRun run = sensor_fault_run(c);
      EXPECT_LE(run.way_m(0.3), kUnanswered_m + kBraking_m)
          << name(sensor_fault.sensor_fault) << ' ' << fault_s;
      EXPECT_TRUE(of_the_sensor(run.reported)) << name(sensor_fault.sensor_fault) << ' ' << fault_s;
      EXPECT_EQ(run.limit_violations, 0U);
    }
  }
}

TEST(SensorFaults, EngagedGuardDoesNotRetreatFurtherOnSensorFault) {
  for (const SensorFault& sensor_fault : {SensorFault{SensorFaultKind::kStuck, 30.0},
                                          SensorFault{SensorFaultKind::kBias, 30.0, Vector3::UnitY()},
                                          SensorFault{SensorFaultKind::kDrift, 10.0, -Vector3::UnitX()}}) {
    SensorFaultCase c;
    c.sensor_fault = sensor_fault;
    c.fault_s = 1.0;
    c.behind_m = -kGuardWall_m;
    c.end_s = 12.0;
    const SensorFaultRun run = sensor_fault_run(c);
    EXPECT_LE(run.way_m(0.9), kUnanswered_m + kBraking_m) << name(sensor_fault.sensor_fault);
    EXPECT_TRUE(of_the_sensor(run.reported)) << name(sensor_fault.sensor_fault);
    EXPECT_NE(run.rows.back().state, SafetyState::kEngaged) << name(sensor_fault.sensor_fault);
  }
}

TEST(SensorFaults, ImpossibleSampleCausesFaultWithoutMotion) {
  for (const double value : {1e300, -1e300, 1e6, 200.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    for (const double behind_m : {-kGuardWall_m, 0.01}) {
      SensorFaultCase c;
      c.sensor_fault = {SensorFaultKind::kSpike, value, Vector3(1, 1, 1).normalized()};
      c.fault_s = 3.0;
      c.behind_m = behind_m;
      c.end_s = 5.0;
      const SensorFaultRun run = sensor_fault_run(c);
      EXPECT_LE(run.way_m(2.999), 1e-4) << value;
      EXPECT_EQ(run.reported, HoldCause::kSensorFault) << value;
      EXPECT_LE(run.reported_s - c.fault_s, 2e-3) << value;
      EXPECT_EQ(run.rows.back().state, SafetyState::kFault) << value;
    }
  }
}

TEST(SensorFaults, FrozenSensorIsReportedDuringRetreat) {
  SensorFaultCase c;
  c.guard.wall_n_per_m = 1e3;
  c.sensor_fault = {SensorFaultKind::kFrozen};
  c.fault_s = 2.0;
  c.silent_s = 2.0;
  const SensorFaultRun run = sensor_fault_run(c);
  EXPECT_EQ(run.reported, HoldCause::kSensorFault);
  EXPECT_EQ(run.rows.back().state, SafetyState::kFault);
  EXPECT_LE(run.way_m(2.0), 0.005);
}

TEST(SensorFaults, SaturatedSensorIsReportedInTenthOfASecond) {
  SensorFaultCase c;
  c.sensor_fault = {SensorFaultKind::kStuck, 40.0};
  c.fault_s = 1.0;
  c.behind_m = -kGuardWall_m;
  SlaveConfig config = sensor_fault_config(c);
  config.sensing.force_range_n = 40.0;
  const SensorFaultRun run = sensor_fault_run(c, config, [](int) { return false; });
  EXPECT_EQ(run.reported, HoldCause::kSensorFault);
  EXPECT_LE(run.reported_s - c.fault_s, 0.1);
}

TEST(SensorFaults, ApproachingWallCausesRetreatAndNoFault) {
  for (const double give_way_m : {0.03, 0.2}) {
    for (const double coming : {0.003, 0.02, 0.05}) {
      for (const double wall_n_per_m : {200.0, 1e3, 5e3}) {
        SensorFaultCase c;
        c.guard.wall_n_per_m = wall_n_per_m;
        c.guard.guard_n = 20.0;
        c.coming_m_per_s = coming;
        c.behind_m = -kGuardWall_m;
        const double pressed_s = c.guard.guard_n / (wall_n_per_m * coming), way_s = 0.03 / coming;
        c.end_s = kGuardWall_m / coming + pressed_s + way_s + 1.0;
        SlaveConfig config = sensor_fault_config(c);
        config.command.give_way_m = give_way_m;
        const SensorFaultRun run = sensor_fault_run(c, config, [](int) { return false; });
        EXPECT_EQ(run.reported, HoldCause::kNone) << coming << ' ' << wall_n_per_m;
        double peak_n = 0.0;
        HoldCause cause = HoldCause::kNone;
        for (const auto& row : run.rows) {
          if (row.cause == HoldCause::kSurfaceApproaching) cause = row.cause;
          if (cause == HoldCause::kNone && row.tool_m.x() > -0.025) peak_n = std::max(peak_n, row.force_n);
        }
        EXPECT_EQ(cause, give_way_m < 0.1 ? HoldCause::kSurfaceApproaching : HoldCause::kNone)
            << coming << ' ' << wall_n_per_m;
        EXPECT_LE(peak_n, kGuardOvershoot * c.guard.guard_n) << coming << ' ' << wall_n_per_m;
      }
    }
  }
}

/// A tool of 5 kg on a robot whose adapter stands still for 10 ms, four times a second.
SensorFaultRun stalling(double wall_behind_m) {
  SensorFaultCase c;
  c.guard.wall_n_per_m = 2e3;
  c.guard.speed_m_per_s = 0.01;
  c.behind_m = wall_behind_m;
  c.end_s = 5.0;
  SlaveConfig config = sensor_fault_config(c);
  config.sensing.tool.mass_kg = 5.0;
  return sensor_fault_run(c, config, [](int tick) { return tick > 250 && tick % 250 < 10; });
}

TEST(SensorFaults, AnAdapterThatStallsMakesNoTouchAndHidesNone) {
  constexpr double kInFront_m = -0.005;
  EXPECT_EQ(stalling(kInFront_m).touches, 0U);
  const SensorFaultRun pressed = stalling(0.02);
  EXPECT_GE(pressed.touches, 1U);
  EXPECT_LE(pressed.peak_n, kGuardOvershoot * 20.0);
}

/// The first zero takes 0.5 s: till then nobody engages; the contact that is met in the next is felt.
TEST(SensorFaults, ZeroingKeepsForceWhileEngaged) {
  for (const double zero_s : {0.5, 100.0}) {
    SensorFaultCase c;
    SlaveConfig config = sensor_fault_config(c);
    config.sensing.zero_s = zero_s;
    const SensorFaultRun run = sensor_fault_run(c, config, [](int) { return false; });
    EXPECT_LE(run.peak_n, kGuardOvershoot * c.guard.guard_n) << zero_s;
    for (const SensorFaultRow& row : run.rows) {
      if (row.t_s < std::min(zero_s, c.end_s)) {
        ASSERT_NE(row.state, SafetyState::kEngaged) << zero_s << ' ' << row.t_s;
      }
    }
    EXPECT_EQ(run.rows.back().state == SafetyState::kEngaged, zero_s < 1.0);
  }
}

}  // namespace
}  // namespace longreach::test::sensor_faults_test
