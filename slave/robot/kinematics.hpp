#pragma once
// Where the tool is, and how it moves, for a chain of six revolute joints.
//   X_WE = A₁(q₁) ... A₆(q₆),  A = Rz(q + θ) Tz(d) Tx(a) Rx(α)     (Denavit, Hartenberg 1955, standard
//   convention) V_WE = J(q) q̇,  column i = [z; z × (p_E - o)] of the axis z through o     (geometric
//   Jacobian, at E in W)
// The robot's base S is the world W. Does not know limits, speeds or singularities.

#include <array>

#include "common/spatial/spatial.hpp"
#include "slave/robot/robot_config.hpp"

namespace longreach {

using Jacobian = Eigen::Matrix<double, 6, kMaxJoints>;  // rows: angular, linear; m and rad

struct ToolKinematics {
  Pose X_WE{};
  Jacobian J = Jacobian::Zero();
};

class Kinematics {
 public:
  explicit Kinematics(const RobotConfig& robot);

  [[nodiscard]] Pose forward(const JointVector& joint_rad) const;
  [[nodiscard]] ToolKinematics forward_with_jacobian(const JointVector& joint_rad) const;

  /// Sum of all link lengths and offsets, at least 1 mm: the robot's characteristic length.
  [[nodiscard]] double reach_m() const { return reach_m_; }

 private:
  struct Link {
    double a_m, d_m, theta_rad, cos_alpha, sin_alpha;
  };
  std::array<Link, kMaxJoints> link_{};
  double reach_m_ = 0.0;
};

}  // namespace longreach
