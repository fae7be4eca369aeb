#pragma once
// The configurations of the space arm in deploy/robots and of a wall, as plain values.

#include "slave/config/slave_config.hpp"
#include "slave/robot/robot.hpp"

namespace longreach::test {

constexpr double kPi = 3.14159265358979323846;

inline RobotConfig space_arm() {
  RobotConfig robot;
  robot.name = "space_arm";
  robot.servo_hz = 10.0;
  robot.joint[0] = {0.0, kPi / 2, 0.0, 0.0, -3.1, 3.1, 0.25, 2.0, 0.0};
  robot.joint[1] = {6.38, 0.0, 0.0, 0.0, -0.05, 2.5, 0.25, 2.0, kPi / 3};
  robot.joint[2] = {7.06, 0.0, 0.0, 0.0, -2.8, -0.1, 0.25, 2.0, -kPi / 2};
  robot.joint[3] = {0.46, -kPi / 2, 0.0, 0.0, -2.1, 2.1, 0.6, 5.0, kPi / 6};
  robot.joint[4] = {0.0, kPi / 2, 0.0, kPi / 2, -1.4, 1.4, 0.6, 5.0, 0.0};
  robot.joint[5] = {0.0, 0.0, 1.42, 0.0, -7.8, 7.8, 0.6, 5.0, 0.0};
  return robot;
}

inline JointVector start_joints() {
  JointVector q;
  q << 0.0, kPi / 3, -kPi / 2, kPi / 6, 0.0, 0.0;
  return q;
}

inline SlaveConfig wall_config(double distance_m, double stiffness_n_per_m, double exponent = 1.0) {
  SlaveConfig config;
  config.robot = space_arm();
  config.scene.name = "wall";
  config.scene.material = {{"wall", stiffness_n_per_m, 1e-3, exponent, 0.1}};
  config.scene.surface = {{"wall", "wall", PlaneConfig{Vector3(distance_m, 0, 0), -Vector3::UnitX(), true}}};
  config.estimator.exponent = exponent;
  return config;
}

}  // namespace longreach::test
