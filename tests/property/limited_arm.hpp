#pragma once
// The arms of deploy/robots with the joint limits and start positions of their files.

#include "deploy/lab/robot/random_arm.hpp"

namespace longreach::test {

struct ShortLimits {
  double min, max, speed, acceleration, start;
};

inline std::vector<NamedArm> limited_arms() {
  std::vector<NamedArm> arms = ready_arms();
  const std::array<ShortLimits, 18> limits{{{-3.1, 3.1, 0.25, 2, 0},
                                            {-0.05, 2.5, 0.25, 2, 1.0471975511965976},
                                            {-2.8, -0.1, 0.25, 2, -1.5707963267948966},
                                            {-2.1, 2.1, 0.6, 5, 0.5235987755982988},
                                            {-1.4, 1.4, 0.6, 5, 0},
                                            {-7.8, 7.8, 0.6, 5, 0},
                                            {-2.7925, 2.7925, 1.4, 8, 0},
                                            {-0.7854, 3.927, 0.9, 6, 0.7853981633974483},
                                            {-3.927, 0.7854, 2.1, 12, -3.141592653589793},
                                            {-1.9199, 2.9671, 4, 25, 0},
                                            {-1.7453, 1.7453, 3.9, 25, 0.7853981633974483},
                                            {-4.6426, 4.6426, 5, 25, 0},
                                            {-6.2832, 6.2832, 2.094, 10, 0},
                                            {-6.2832, 6.2832, 2.094, 10, -1.5},
                                            {-6.2832, 6.2832, 3.141, 15, 1.5},
                                            {-6.2832, 6.2832, 3.141, 15, -1.5},
                                            {-6.2832, 6.2832, 3.141, 15, -1.5},
                                            {-6.2832, 6.2832, 3.141, 15, 0}}};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    JointConfig& j = arms[i / kMaxJoints].robot.joint[i % kMaxJoints];
    const ShortLimits& l = limits[i];
    j.min_rad = l.min, j.max_rad = l.max, j.start_rad = l.start;
    j.speed_max_rad_per_s = l.speed, j.acceleration_max_rad_per_s2 = l.acceleration;
    j.jerk_max_rad_per_s3 = 500.0 * l.acceleration;
  }
  return arms;
}

}  // namespace longreach::test
