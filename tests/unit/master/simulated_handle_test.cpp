#include "master/devices/simulated_handle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach {
namespace {

Time at(int tick) { return Time{} + std::chrono::milliseconds(tick); }

TEST(SimulatedHandle, FollowsTheStepResponseOfAMassOnASpring) {
  // A light hand pulls the handle to 10 mm: second-order closed form.
  DeviceConfig config;
  config.resolution_m = 0.0;
  SimulatedHandle handle(config);
  handle.set_target({.position_m = {0.01, 0.0, 0.0}, .grip = Grip::kLight});
  const HandModel hand = hand_model(Grip::kLight);
  const double m = config.mass_kg + hand.mass_kg;
  const double b = config.damping_n_s_per_m + hand.damping_n_s_per_m;
  const double w0 = std::sqrt(hand.stiffness_n_per_m / m);
  const double zeta = b / (2.0 * std::sqrt(hand.stiffness_n_per_m * m));
  ASSERT_LT(zeta, 1.0);
  const double wd = w0 * std::sqrt(1.0 - zeta * zeta);
  for (int i = 0; i <= 500; ++i) {
    handle.read(at(i));
    const double t = i * 1e-3;
    const double x =
        0.01 * (1.0 - std::exp(-zeta * w0 * t) * (std::cos(wd * t) + zeta * w0 / wd * std::sin(wd * t)));
    ASSERT_NEAR(handle.true_position_m().x(), x, 1e-5) << "at tick " << i;
  }
}

TEST(SimulatedHandle, MovesByConstantForceWhenReleased) {
  DeviceConfig config;
  config.damping_n_s_per_m = 0.0;
  config.resolution_m = 0.0;
  SimulatedHandle handle(config);
  handle.set_target({.grip = Grip::kReleased});
  handle.read(at(0));
  handle.write({.force = {0.0, 1.0, 0.0}});
  for (int i = 1; i <= 50; ++i) handle.read(at(i));
  EXPECT_NEAR(handle.true_position_m().y(), 0.5 * (1.0 / config.mass_kg) * 0.05 * 0.05, 1e-5);
  EXPECT_NEAR(handle.true_velocity_m_per_s().y(), 0.05 / config.mass_kg, 1e-9);
}

TEST(SimulatedHandle, QuantisesWhatItMeasures) {
  DeviceConfig config;
  config.resolution_m = 1e-4;
  SimulatedHandle handle(config);
  handle.set_target({.position_m = {0.01, 0.003, 0.0}});
  for (int i = 0; i < 300; ++i) {
    const HandleState state = handle.read(at(i));
    const double steps = state.p_MH.x() / 1e-4;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
    ASSERT_NEAR(state.p_MH.x(), handle.true_position_m().x(), 0.5e-4 + 1e-12);
  }
}

TEST(SimulatedHandle, StaysInsideItsWorkspace) {
  DeviceConfig config;
  SimulatedHandle handle(config);
  handle.set_target({.position_m = {0.3, 0.0, 0.0}, .rotation_rad = {0.0, 3.0, 0.0}});
  for (int i = 0; i < 3000; ++i) handle.read(at(i));
  EXPECT_LT(handle.true_position_m().norm(), config.workspace_m + 0.02);
  EXPECT_LE(log_rotation(handle.read(at(3001)).q_MH).norm(), config.workspace_rad + 1e-3);
}

TEST(SimulatedHandle, LimitsItsMotors) {
  DeviceConfig config;
  config.damping_n_s_per_m = 0.0;
  config.force_max_n = 2.0;
  config.resolution_m = 0.0;
  SimulatedHandle handle(config);
  handle.set_target({.grip = Grip::kReleased});
  handle.read(at(0));
  handle.write({.force = {1000.0, 0.0, 0.0}});
  for (int i = 1; i <= 10; ++i) handle.read(at(i));
  EXPECT_NEAR(handle.true_velocity_m_per_s().x(), 2.0 * 0.01 / config.mass_kg, 1e-9);
}

}  // namespace
}  // namespace longreach
