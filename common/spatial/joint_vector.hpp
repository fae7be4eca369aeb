#pragma once
// Values of the joints of the arm.

#include <Eigen/Core>

namespace longreach {

constexpr int kMaxJoints = 6;

/// One number for each joint: rad, or m for a prismatic joint, and their derivatives.
using JointVector = Eigen::Matrix<double, kMaxJoints, 1>;

}  // namespace longreach
