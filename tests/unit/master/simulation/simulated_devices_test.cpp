#include "master/simulation/simulated_devices.hpp"

#include <gtest/gtest.h>

namespace longreach::simulated_devices_test {
namespace {

TEST(SimulatedDevices, KeepTheirOrientationIfTheyDoNotTurn) {
  for (const bool turns : {true, false}) {
    DeviceConfig config;
    config.turns = turns;
    SimulatedDevices devices(config);
    HandTarget hand;
    hand.position_m.x() = 0.01;
    hand.rotation_rad.z() = 0.2;
    devices.set_target(hand);
    HandleState handle;
    for (int i = 1; i <= 1000; ++i) {
      handle = devices.read(Time{std::chrono::milliseconds(i)});
      devices.write({.moment = Vector3(0.0, 0.0, 0.01)});
    }
    EXPECT_TRUE(handle.ok);
    EXPECT_NEAR(handle.p_MH.x(), 0.01, 1e-3);
    EXPECT_EQ(log_rotation(handle.q_MH).z() > 0.1, turns);
    EXPECT_EQ(handle.angular_rad_per_s.isZero(0.0), !turns);
  }
}

}  // namespace
}  // namespace longreach::simulated_devices_test
