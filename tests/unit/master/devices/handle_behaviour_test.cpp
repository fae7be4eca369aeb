#include "master/devices/handle_behaviour.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "master/simulation/simulated_devices.hpp"

namespace longreach::handle_behaviour_test {
namespace {

Time at(int tick) { return Time{} + std::chrono::milliseconds(tick); }

/// The simulated devices with nothing but their behaviour.
struct Bench {
  explicit Bench(const DeviceConfig& c = {}) : config(c), devices(c), behaviour(c) {}

  Wrench tick() {
    handle = devices.read(at(++ticks));
    const Wrench F = behaviour.step(handle, 1e-3);
    devices.write(F);
    return F;
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  DeviceConfig config;
  SimulatedDevices devices;
  HandleBehaviour behaviour;
  HandleState handle{};
  int ticks = 0;
};

const HandTarget kNobody{.grip = Grip::kReleased};

TEST(HandleBehaviour, TakesAHandleHomeThatIsLetGo) {
  Bench b;
  ASSERT_TRUE(b.devices.place({{0.03, -0.02, 0.01}, exp_rotation({0.3, 0.2, -0.1})}));
  b.devices.set_target(kNobody);
  b.run(1);
  EXPECT_LT(b.behaviour.step(b.handle, 1e-3).force.norm(), 0.1);  // begins without force
  double fastest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    b.tick();
    fastest = std::max(fastest, b.devices.delta().velocity_m_per_s().norm());
  }
  EXPECT_LT(b.devices.delta().position_m().norm(), 2e-3);  // friction holds it where the spring is weak
  EXPECT_LT(log_rotation(b.devices.spherical().orientation()).norm(), 0.01);
  EXPECT_LT(fastest, 2.0 * b.config.behaviour.home_speed_m_per_s);
}

TEST(HandleBehaviour, LetsAHandleStayWhereItIsLeft) {
  DeviceConfig config;
  config.behaviour.idle = IdleRule::kStay;
  Bench b(config);
  const Pose left{{0.03, -0.02, 0.03}, exp_rotation({0.3, 0.2, -0.1})};
  ASSERT_TRUE(b.devices.place(left));
  b.devices.set_target(kNobody);
  b.run(10000);
  EXPECT_LT((b.devices.delta().position_m() - left.p).norm(), 1e-4);
  EXPECT_LT(b.devices.spherical().orientation().angularDistance(left.q), 1e-3);
}

TEST(HandleBehaviour, DoesNothingInAHandInsideTheWorkspace) {
  Bench b;
  b.devices.set_target({.position_m = {0.02, 0.0, 0.0}, .rotation_rad = {0.1, 0.0, 0.0}});
  for (int i = 0; i < 500; ++i) {
    const Wrench F = b.tick();
    EXPECT_EQ(F.force, Vector3::Zero());
    EXPECT_EQ(F.moment, Vector3::Zero());
  }
}

TEST(HandleBehaviour, StopsSoftlyBeforeTheEdge) {
  Bench b;
  b.devices.set_target(
      {.position_m = {0.0, 0.12, 0.0}, .rotation_rad = {0.0, 0.0, 1.2}, .grip = Grip::kLight});
  b.run(2000);
  EXPECT_GT(b.devices.delta().position_m().norm(),
            b.config.behaviour.stop_share * b.config.delta.workspace_m);
  EXPECT_LT(b.devices.delta().position_m().norm(), b.config.delta.workspace_m);
  const double turned = log_rotation(b.devices.spherical().orientation()).norm();
  EXPECT_GT(turned, b.config.behaviour.stop_share * b.config.spherical.workspace_rad);
}

TEST(HandleBehaviour, KeepsToTheAxisThatIsMovedFirstAndFreesItNearHome) {
  DeviceConfig config;
  config.behaviour.motion = HandleMotion::kDecoupled;
  Bench b(config);
  b.devices.set_target({.position_m = {0.01, 0.002, 0.0}, .grip = Grip::kLight});
  b.run(1000);
  EXPECT_EQ(b.behaviour.translation().guided_axis(), 0);
  b.devices.set_target({.position_m = {0.02, 0.02, 0.0}, .grip = Grip::kLight});
  b.run(1500);
  EXPECT_GT(b.handle.p_MH.x(), 0.018);
  EXPECT_LT(b.handle.p_MH.y(), 0.009);  // the guide is almost four times as stiff as the hand
  b.devices.set_target({.position_m = {0.0, 0.0, 0.0}, .grip = Grip::kLight});
  b.run(2000);
  EXPECT_EQ(b.behaviour.translation().guided_axis(), -1);
  b.devices.set_target({.position_m = {0.0, 0.0, 0.015}, .grip = Grip::kLight});
  b.run(1000);
  EXPECT_EQ(b.behaviour.translation().guided_axis(), 2);
}

TEST(HandleBehaviour, NeverStepsTheForceAndTellsEveryJouleItSupplies) {
  for (const auto motion : {HandleMotion::kCoupled, HandleMotion::kDecoupled}) {
    DeviceConfig config;
    config.behaviour.motion = motion;
    Bench b(config);
    Vector3 x_last = Vector3::Zero(), f_last = Vector3::Zero();
    double rest_j = 0.0, stored_j = 0.0, least_j = 0.0;
    for (int i = 0; i < 12000; ++i) {
      HandTarget target{.position_m = {0.05 * std::sin(0.003 * i), 0.09 * std::sin(0.0011 * i), 0.02}};
      target.grip = i / 1500 % 2 == 0 ? Grip::kLight : Grip::kReleased;
      b.devices.set_target(target);
      const Wrench F = b.tick();
      const double entered_j = -f_last.dot(b.handle.p_MH - x_last);
      const double now_j = b.behaviour.translation().energy_j();
      rest_j += entered_j - (now_j - stored_j) + b.behaviour.translation().supplied_j();
      least_j = std::min(least_j, rest_j);
      stored_j = now_j;
      // Fast motion changes the force of a spring too: per millimetre at most the sum of all springs.
      const double most_n = 0.3 + 2600.0 * (b.handle.p_MH - x_last).norm();
      // Taking hold again ends the spring at once, which is a fall of force, not a rise.
      if (F.force.norm() > f_last.norm()) {
        EXPECT_LT((F.force - f_last).norm(), most_n) << i;
      }
      x_last = b.handle.p_MH;
      f_last = F.force;
    }
    EXPECT_GT(least_j, -2e-3);  // of springs held for a sample, paid by the device's own friction
  }
}

TEST(HandleBehaviour, GivesNothingForWhatIsNotFinite) {
  HandleBehaviour behaviour{DeviceConfig{}};
  HandleState handle;
  handle.held = false;
  handle.p_MH.x() = std::nan("");
  handle.q_MH.x() = HUGE_VAL;
  const Wrench F = behaviour.step(handle, 1e-3);
  EXPECT_EQ(F.force, Vector3::Zero());
  EXPECT_EQ(F.moment, Vector3::Zero());
}

}  // namespace
}  // namespace longreach::handle_behaviour_test
