#pragma once
// A robot as its file describes it.

#include <array>
#include <string>

#include "slave/robot/robot.hpp"

namespace longreach {

/// Row of a standard Denavit-Hartenberg table, A = Rz(q + theta) Tz(d) Tx(a) Rx(alpha), and the joint's
/// limits.
struct JointConfig {
  double a_m = 0.0;
  double alpha_rad = 0.0;
  double d_m = 0.0;
  double theta_rad = 0.0;
  double min_rad = -3.14159;
  double max_rad = 3.14159;
  double speed_max_rad_per_s = 1.0;
  double acceleration_max_rad_per_s2 = 5.0;
  double start_rad = 0.0;
};

struct RobotConfig {
  std::string name;
  std::string basis;
  std::array<JointConfig, kMaxJoints> joint{};
  double servo_hz = 10.0;  // bandwidth of the joint servos; 0: ideal
};

}  // namespace longreach
