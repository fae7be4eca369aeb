#pragma once
// Robot arms for tests: the arms of deploy/robots as plain values, and random arms of each family.

#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach::test {

constexpr double kHalfPi = 1.57079632679489661923;

struct NamedArm {
  std::string name;
  RobotConfig robot;            // without joint limits
  RobotConfig limited = robot;  // with the joint limits of its file, if it has one
};

inline RobotConfig unlimited(RobotConfig robot) {
  for (JointConfig& j : robot.joint) j.min_rad = -12.6, j.max_rad = 12.6;
  return robot;
}

struct ShortRow {
  double a_m, alpha_rad, d_m, theta_rad, min_rad, max_rad;
};

inline NamedArm from_rows(const std::string& name, const std::array<ShortRow, kMaxJoints>& rows) {
  RobotConfig robot;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    robot.joint[i].a_m = rows[i].a_m;
    robot.joint[i].alpha_rad = rows[i].alpha_rad;
    robot.joint[i].d_m = rows[i].d_m;
    robot.joint[i].theta_rad = rows[i].theta_rad;
    robot.joint[i].min_rad = rows[i].min_rad;
    robot.joint[i].max_rad = rows[i].max_rad;
  }
  return {name, unlimited(robot), robot};
}

/// Returns the six-joint arms of deploy/robots. A test in tests/unit/common/config compares them with the
/// files.
inline std::vector<NamedArm> ready_arms() {
  constexpr double h = kHalfPi;
  return {from_rows("space_arm", {{{0, h, 0, 0, -3.1, 3.1},
                                   {6.38, 0, 0, 0, -0.05, 2.5},
                                   {7.06, 0, 0, 0, -2.8, -0.1},
                                   {0.46, -h, 0, 0, -2.1, 2.1},
                                   {0, h, 0, h, -1.4, 1.4},
                                   {0, 0, 1.42, 0, -7.8, 7.8}}}),
          from_rows("puma560", {{{0, h, 0.6718, 0, -2.7925, 2.7925},
                                 {0.4318, 0, 0, 0, -0.7854, 3.927},
                                 {0.0203, -h, 0.15005, 0, -3.927, 0.7854},
                                 {0, h, 0.4318, 0, -1.9199, 2.9671},
                                 {0, -h, 0, 0, -1.7453, 1.7453},
                                 {0, 0, 0.05625, 0, -4.6426, 4.6426}}}),
          from_rows("ur10", {{{0, h, 0.1273, 0, -6.2831, 6.2831},
                              {-0.612, 0, 0, 0, -6.2831, 6.2831},
                              {-0.5723, 0, 0, 0, -6.2831, 6.2831},
                              {0, h, 0.163941, 0, -6.2831, 6.2831},
                              {0, -h, 0.1157, 0, -6.2831, 6.2831},
                              {0, 0, 0.0922, 0, -6.2831, 6.2831}}})};
}

inline JointVector random_joints(Random& random, double range_rad = 3.14) {
  JointVector q;
  for (double& x : q) x = random.uniform(-range_rad, range_rad);
  return q;
}

inline JointVector random_joints(Random& random, const RobotConfig& robot) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    q[i] = random.uniform(j.min_rad, j.max_rad);
  }
  return q;
}

/// Returns a robot with prismatic joints along z, y and x, as in deploy/robots/cartesian.txtpb.
inline RobotConfig cartesian() {
  RobotConfig robot;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    robot.joint[i].kind = i < 3 ? JointKind::kPrismatic : JointKind::kFixed;
    if (i < 3) robot.joint[i].min_rad = -1.0, robot.joint[i].max_rad = 1.0;
  }
  robot.joint[0].alpha_rad = -kHalfPi;
  robot.joint[1].theta_rad = robot.joint[1].alpha_rad = kHalfPi;
  return robot;
}

/// Returns a random arm with lengths in [-1, 1] m, arbitrary twists and an arbitrary tool.
inline RobotConfig random_arm(Random& random) {
  RobotConfig robot;
  for (JointConfig& j : robot.joint) {
    j.a_m = random.uniform(-1, 1);
    j.d_m = random.uniform(-1, 1);
    j.alpha_rad = random.uniform(-3, 3);
    j.theta_rad = random.uniform(-3, 3);
  }
  for (int i = 0; i < 3; ++i) {
    robot.tool.position_m[i] = random.uniform(-1, 1);
    robot.tool.rotation_rad[i] = random.uniform(-1, 1);
  }
  return unlimited(robot);
}

/// Returns a random arm in which the three joint axes from `first` on (counted from 0) intersect in one point
/// or are parallel. If they are parallel, each of the last two axes is reversed in a third of the cases.
inline RobotConfig random_arm(Random& random, ArmFamily family, std::size_t first) {
  RobotConfig robot = random_arm(random);
  JointConfig &one = robot.joint[first], &two = robot.joint[first + 1];
  if (family == ArmFamily::kSpherical) {
    one.a_m = two.a_m = two.d_m = 0.0;
  } else {
    const double way = random.uniform();
    one.alpha_rad = way < 0.33 ? 2.0 * kHalfPi : 0.0;
    two.alpha_rad = way > 0.67 ? -2.0 * kHalfPi : 0.0;
  }
  return robot;
}

/// Returns the deviation of the tool at `q` from `goal`: the larger of the angle in rad and the distance as a
/// fraction of the reach. It is computed in long double from the Denavit-Hartenberg parameters, independently
/// of the code under test.
double exact_error(const RobotConfig& robot, const JointVector& q, const Pose& goal, double reach_m);

/// Returns the maximum difference between two sets of joint angles modulo full turns, rad.
double apart(const JointVector& a, const JointVector& b);

}  // namespace longreach::test
