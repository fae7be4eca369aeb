// What a sensor that was found to lie has made of surfaces is not there.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/slave/node_loop.hpp"

namespace longreach::slave_sensing_test {
namespace {

using test::Loop;

bool knows_a_surface(const Loop& loop) {
  return std::ranges::any_of(loop.last_report->translation.surfaces,
                             [](const ReportedSurface& s) { return s.touch > 0; });
}

TEST(SlaveSensing, AForceThatOpposesItsReliefLeavesNoSurface) {
  Loop loop(test::wall_config(0.9, 1000.0));
  loop.engage();
  loop.run(0.2);
  EXPECT_FALSE(knows_a_surface(loop));
  const double begun_m = loop.travelled();
  loop.sensor_fault = [&](RobotState& reported) {
    reported.F_F_W.force.x() += 21.0 + 2000.0 * std::max(loop.travelled() - begun_m, 0.0);
  };
  loop.run(0.02);
  EXPECT_TRUE(knows_a_surface(loop)) << "before the lie is found";
  loop.run(5.0);
  ASSERT_EQ(loop.view().cause, HoldCause::kSensorSign);
  EXPECT_FALSE(knows_a_surface(loop));
  loop.sensor_fault = {};
  loop.engage(2);
  loop.run(0.5);
  EXPECT_FALSE(knows_a_surface(loop));
  EXPECT_FALSE(loop.view().in_contact);
}

TEST(SlaveSensing, WhatPressesWhenTheSensorIsRightAgainIsANewTouch) {
  Loop loop(test::wall_config(0.02, 1000.0));
  loop.engage();
  loop.move_to(0.025, 0.02);
  loop.run(1.0);
  ASSERT_TRUE(loop.view().in_contact);
  const std::uint32_t touch = loop.view().touch;
  loop.sensor_fault = [](RobotState& reported) {
    reported.F_F_W.force.x() = std::numeric_limits<double>::infinity();
  };
  loop.run(0.1);
  EXPECT_EQ(loop.view().cause, HoldCause::kSensorFault);
  EXPECT_FALSE(knows_a_surface(loop));
  loop.sensor_fault = {};
  loop.engage(2);
  loop.run(0.1);
  EXPECT_TRUE(loop.view().in_contact);
  EXPECT_GT(loop.view().touch, touch);
}

// The guard of the moment is 5 N m, and a bias may have up to 0.6 of it.
TEST(SlaveSensing, ReportsABiasOfTheMomentThatIsRefused) {
  for (const double bias_nm : {2.5, 3.5}) {
    SlaveConfig config = test::wall_config(0.9, 1000.0);
    config.sensing.touch_n = 0.0;
    Loop loop(config);
    loop.sensor_fault = [&](RobotState& reported) { reported.F_F_W.moment.y() += bias_nm; };
    loop.engage();
    loop.move_to(0.03, 0.02);
    EXPECT_EQ(loop.view().sensor_zero.count, 1U) << "the force is zeroed";
    EXPECT_EQ(loop.view().sensor_zero.refused_n, 0.0);
    EXPECT_NEAR(loop.view().sensor_zero.refused_nm, bias_nm > 3.0 ? bias_nm : 0.0, 0.05);
  }
}

// As from an adapter that was killed, with robot_adapter.silence_s = 0.5.
TEST(SlaveSensing, WhatDoesNotArriveIsNoConstantSensor) {
  for (const bool arrives : {false, true}) {
    Loop loop(test::wall_config(0.9, 1000.0));
    loop.engage();
    loop.move_to(0.01, 0.02);
    std::optional<RobotState> last;
    int ticks = 0;
    loop.sensor_fault = [&](RobotState& reported) {
      if (!last) last = reported;
      reported = *last;
      if (!arrives) reported.age_s = 1e-3 * ++ticks;
      reported.ok = ticks < 500;
    };
    loop.run(0.6);
    EXPECT_EQ(loop.view().cause, arrives ? HoldCause::kSensorFault : HoldCause::kRobotFault);
  }
}

}  // namespace
}  // namespace longreach::slave_sensing_test
