#include "slave/simulation/simulated_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach::simulated_arm_test {
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

TEST(SimulatedArm, WithoutBodiesTracksNone) {
  EXPECT_TRUE(SimulatedArm(test::wall_config(5.0, 1000.0), Random(1)).tracked_bodies().empty());
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

TEST(SimulatedArm, BrakesItsJointsWithinTheirLimitsWhenNobodyWrites) {
  SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
  Time now{};
  arm.read(now);
  JointVector set = test::start_joints();
  set[5] += 3.0;
  arm.write(set);
  double at_20ms = 0.0, before_rad_per_s = 0.6;
  RobotState state;
  for (int i = 1; i <= 200; ++i) {
    now += milliseconds(1);
    state = arm.read(now);
    if (i == 20) at_20ms = state.joint_rad[5];
    ASSERT_LE(std::abs(state.joint_rad_per_s[5] - before_rad_per_s), 5e-3 * (1.0 + 1e-9)) << i;
    before_rad_per_s = state.joint_rad_per_s[5];
  }
  EXPECT_TRUE(state.ok);
  EXPECT_TRUE(arm.watchdog_stopped());
  EXPECT_NEAR(at_20ms, 0.012, 1e-9);
  EXPECT_NEAR(state.joint_rad[5], at_20ms + 0.6 * 0.6 / (2.0 * 5.0), 1e-9);
  EXPECT_EQ(state.joint_rad_per_s[5], 0.0);
}

// A minute, with a wall that pushes with 50 N, or as much as joints on springs let it.
TEST(SimulatedArm, StaysWhereItIsWithoutASetpointWhateverPushes) {
  for (const bool springs : {false, true}) {
    SlaveConfig config = test::wall_config(-0.05, 1000.0);
    if (springs) {
      for (JointConfig& j : config.robot.joint) {
        j.stiffness_nm_per_rad = 1e6;
        j.damping_nm_s_per_rad = 6e4;
        j.inertia_kg_m2 = 1e3;
      }
    }
    SimulatedArm arm(config, Random(1));
    Time now{};
    Vector3 at_m = Vector3::Zero();
    for (int i = 0; i < 70'000; ++i) {
      arm.read(now += milliseconds(1));
      arm.write(std::nullopt);
      if (i == 10'000) at_m = arm.true_pose().p;
    }
    EXPECT_GT(arm.true_wrench().force.norm(), 30.0) << springs;
    EXPECT_LT((arm.true_pose().p - at_m).norm(), 1e-6) << springs;
    EXPECT_FALSE(arm.watchdog_stopped());
  }
}

TEST(SimulatedArm, TakesASetpointAgainAfterARest) {
  SimulatedArm arm(test::wall_config(5.0, 1000.0), Random(1));
  Time now{};
  arm.read(now);
  JointVector set = test::start_joints();
  set[5] += 0.01;
  for (int i = 0; i < 200; ++i) {
    arm.write(i < 100 ? std::nullopt : std::optional<JointVector>(set));
    const double rad = arm.read(now += milliseconds(1)).joint_rad[5];
    if (i < 100) {
      ASSERT_EQ(rad, 0.0);
    }
  }
  EXPECT_NEAR(arm.read(now).joint_rad[5], 0.01, 1e-4);
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
  EXPECT_NEAR(arm.material_stiffness(arm.true_pose().p), 1000.0, 1e-4);
}

// An arm on springs, pushed 2 mm into walls of any stiffness and left alone: what it has of energy never
// rises, and no force pulls. A force that is held for a tick would throw it off the wall again and again.
TEST(SimulatedArm, ContactCreatesNoEnergyHoweverStiffItIs) {
  for (const double stiffness : {1e3, 1e5, 1e7, 1e9}) {
    for (const double exponent : {1.0, 1.5}) {
      SlaveConfig config = test::wall_config(-0.002, stiffness, exponent);
      config.scene.material[0].damping_s_per_m = 0.0;
      for (JointConfig& joint : config.robot.joint) {
        joint.stiffness_nm_per_rad = 5e4;
        joint.inertia_kg_m2 = 50.0;
      }
      SimulatedArm arm(config, Random(1));
      const JointVector servo = test::start_joints();
      const HuntCrossley law{stiffness / std::pow(1e-3, exponent - 1.0), exponent, 0.0};
      Time now{};
      RobotState state = arm.read(now);
      const auto energy = [&] {
        double sum = law.energy_j(arm.true_penetration_m());
        for (int i = 0; i < kMaxJoints; ++i) {
          sum += 25.0 * state.joint_rad_per_s[i] * state.joint_rad_per_s[i] +
                 2.5e4 * (state.joint_rad[i] - servo[i]) * (state.joint_rad[i] - servo[i]);
        }
        return sum;
      };
      const double start = energy();
      double most = 0.0;
      int touching = 0;
      for (int i = 0; i < 5000; ++i) {
        arm.write(servo);
        now += milliseconds(1);
        state = arm.read(now);
        most = std::max(most, energy() / start);
        ASSERT_LE(arm.true_wrench().force.x(), 0.0);
        touching += arm.true_penetration_m() > 0.0 ? 1 : 0;
      }
      EXPECT_LE(most, 1.0 + 2e-5) << stiffness << " " << exponent;
      EXPECT_GT(touching, 5);
      std::printf("wall of %g N/m, n = %g: at most %.6f of the energy, %d ticks touching\n", stiffness,
                  exponent, most, touching);
    }
  }
}

}  // namespace
}  // namespace longreach::simulated_arm_test
