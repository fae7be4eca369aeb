#include "slave/robot/simulated_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(SimulatedArm, ServoIsExactForAnyTick) {
  // q(t) = q_set (1 - exp(-ω t)), ω = 2π 10 Hz, below the speed limit.
  for (const int tick_us : {250, 1000, 4000}) {
    SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
    Time now{};
    arm.read(now);
    JointVector set = test::start_joints();
    set[5] += 0.005;
    RobotState state;
    for (int t = 0; t < 40000; t += tick_us) {
      arm.write(set);
      now += microseconds(tick_us);
      state = arm.read(now);
    }
    const double expected = 0.005 * -std::expm1(-2.0 * test::kPi * 10.0 * 0.04);
    EXPECT_NEAR(state.joint_rad[5], expected, 1e-12) << tick_us;
  }
}

TEST(SimulatedArm, JointsKeepTheirSpeedLimit) {
  SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
  Time now{};
  JointVector before = arm.read(now).joint_rad;
  JointVector set = before;
  set[5] += 3.0;
  for (int i = 0; i < 1000; ++i) {
    arm.write(set);
    now += milliseconds(1);
    const RobotState state = arm.read(now);
    EXPECT_LE(std::abs(state.joint_rad[5] - before[5]), 0.6e-3 * (1 + 1e-9));
    before = state.joint_rad;
  }
  EXPECT_NEAR(before[5], 0.6, 1e-3);
}

TEST(SimulatedArm, StopsItsJointsWithoutSetpoints) {
  SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
  Time now{};
  arm.read(now);
  JointVector set = test::start_joints();
  set[5] += 3.0;
  arm.write(set);
  double at_20ms = 0.0;
  RobotState state;
  for (int i = 1; i <= 100; ++i) {
    now += milliseconds(1);
    state = arm.read(now);
    if (i == 20) at_20ms = state.joint_rad[5];
  }
  EXPECT_TRUE(state.ok);
  EXPECT_TRUE(arm.watchdog_stopped());
  EXPECT_NEAR(at_20ms, 0.012, 1e-9);
  EXPECT_NEAR(state.joint_rad[5], at_20ms, 1e-9);
  EXPECT_EQ(state.joint_rad_per_s[5], 0.0);
}

TEST(SimulatedArm, IgnoresSetpointsThatAreNotFinite) {
  SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
  arm.read(Time{});
  JointVector set = test::start_joints();
  set[2] = std::numeric_limits<double>::quiet_NaN();
  arm.write(set);
  EXPECT_EQ(arm.read(Time{milliseconds(1)}).joint_rad, test::start_joints());
  EXPECT_EQ(arm.rejected_setpoints(), 1U);
}

TEST(SimulatedArm, SensorNoiseHasTheConfiguredSpreadAndIsSeeded) {
  const SlaveConfig config = test::wall_config(-0.002, 1000.0);  // starts 2 mm deep
  SimulatedArm arm(config, Random(7)), twin(config, Random(7));
  Time now{};
  double sum = 0.0, squares = 0.0;
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    now += milliseconds(1);
    const double f = arm.read(now).F_F_W.force.x();
    EXPECT_EQ(f, twin.read(now).F_F_W.force.x());
    sum += f;
    squares += f * f;
  }
  const double mean = sum / kN;
  EXPECT_NEAR(mean, -2.0, 5 * 0.05 / std::sqrt(kN));
  EXPECT_NEAR(std::sqrt(squares / kN - mean * mean), 0.05, 0.002);
  EXPECT_NEAR(arm.true_wrench().force.x(), -2.0, 1e-9);
  EXPECT_NEAR(arm.true_penetration_m(), 0.002, 1e-12);
  EXPECT_DOUBLE_EQ(arm.material_secant(0.002), 1000.0);
}

}  // namespace
}  // namespace longreach
