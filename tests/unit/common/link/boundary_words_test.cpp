#include "common/link/boundary_words.hpp"

#include <gtest/gtest.h>

namespace longreach::boundary_words_test {
namespace {

Pose at(double x, double y, double z) { return {{x, y, z}, Quaternion::Identity()}; }

TEST(BoundaryWords, NameTheJointAndTheDirection) {
  const Pose tool = at(0, 0, 0);
  EXPECT_EQ(boundary_in_words({}, tool, at(1, 0, 0)), "");
  EXPECT_EQ(boundary_in_words({.unreachable = true}, tool, at(0.003, 0, 0.001)),
            "end of the reach, towards +x");
  EXPECT_EQ(boundary_in_words({.joint_position = true, .joint = 5}, tool, at(0.001, -0.02, 0)),
            "joint 5 is at its upper limit, towards -y");
  EXPECT_EQ(boundary_in_words({.joint_position = true, .joint = -2}, tool,
                              {tool.p, exp_rotation(Vector3(0, 0, -0.1))}),
            "joint 2 is at its lower limit, about -z");
  EXPECT_EQ(boundary_in_words({.joint_position = true}, tool, tool), "a joint is at its limit");
}

TEST(BoundaryWords, NameTheLimitThatALoadSets) {
  EXPECT_EQ(load_limit_in_words(0.0, 0.0), "");
  EXPECT_EQ(load_limit_in_words(0.5, 0.125),
            "acceleration limited to 0.5 m/s² and 0.125 rad/s²: load in the gripper");
  EXPECT_EQ(load_limit_in_words(0.5123456f, 0.0), "acceleration limited to 0.512 m/s²: load in the gripper");
  EXPECT_EQ(load_limit_in_words(0.0, 0.75), "acceleration limited to 0.75 rad/s²: load in the gripper");
}

}  // namespace
}  // namespace longreach::boundary_words_test
