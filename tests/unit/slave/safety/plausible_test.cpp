#include "slave/safety/plausible.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace longreach::plausible_test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TEST(Plausible, JointsAreFiniteNumbers) {
  RobotState robot;
  EXPECT_TRUE(finite(robot));
  robot.joint_rad[2] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(finite(robot));
  robot.joint_rad[2] = 0.0;
  robot.joint_rad_per_s[5] = kNoNumber;
  EXPECT_FALSE(finite(robot));
}

TEST(Plausible, GoalsAreWhatSomebodyCouldMean) {
  const auto with = [](const Vector3& position_m, const Vector3& rotation_rad) {
    MotionCommand command;
    command.position_m = position_m;
    command.rotation_rad = rotation_rad;
    return possible(command);
  };
  EXPECT_TRUE(with(Vector3::Zero(), Vector3::Zero()));
  EXPECT_TRUE(with(Vector3(0, -999.0, 0), Vector3(0, 0, 99.0)));
  EXPECT_FALSE(with(Vector3(0, -1001.0, 0), Vector3::Zero()));
  EXPECT_FALSE(with(Vector3::Zero(), Vector3(-101.0, 0, 0)));
  EXPECT_FALSE(with(Vector3(kNoNumber, 0, 0), Vector3::Zero()));
  EXPECT_FALSE(with(Vector3::Zero(), Vector3(0, kNoNumber, 0)));
  EXPECT_FALSE(with(Vector3(1e308, 1e308, 0), Vector3::Zero())) << "whose norm is not finite";
}

}  // namespace
}  // namespace longreach::plausible_test
