#pragma once
// Pose and velocity of the tool at the end of a chain of six joints.
//   X_WE = B A₁(q₁) ... A₆(q₆) E,  A = Rz(q + θ) Tz(d) Tx(a) Rx(α) Ry(β)
//   V_WE = J(q) q̇,  column i = [z; z × (p_E - o)] for the axis z through o, [0; z] for a prismatic joint
// B is the base, E the tool frame. β is 0 (Denavit, Hartenberg 1955) except between nearly parallel axes
// (Hayati 1983). A modified row (Craig) is Rx(α) Tx(a) Rz(q + θ) Tz(d); its Rx Tx is moved to the previous
// joint, or to B for the first row. Calibration can produce rows whose common normal is far away; these are
// rewritten (joint_rows.hpp) because lengths much greater than the arm would reduce the numerical accuracy.
// The base S of the robot is the world W. Limits, speeds and singularities are not considered.

#include <array>

#include "common/spatial/joint_rows.hpp"
#include "schema/config_slave.hpp"
#include "slave/kinematics/rigid.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

using Jacobian = Eigen::Matrix<double, 6, kMaxJoints>;  // rows: angular, linear; m and rad

struct ToolKinematics {
  Pose X_WE{};
  Jacobian J;
};

/// The same as ToolKinematics, but with the rotation as a matrix, for the solvers.
struct RigidKinematics {
  Rigid X_WE{};
  Jacobian J;
};

/// Returns the joint positions at which the robot starts, rad or m.
JointVector start_joints(const RobotConfig& robot);

class Kinematics {
 public:
  explicit Kinematics(const RobotConfig& robot);

  [[nodiscard]] Pose forward(const JointVector& joint_rad) const { return to_pose(rigid_forward(joint_rad)); }
  [[nodiscard]] Rigid rigid_forward(const JointVector& joint_rad) const;
  [[nodiscard]] ToolKinematics forward_with_jacobian(const JointVector& joint_rad) const;
  [[nodiscard]] RigidKinematics rigid_with_jacobian(const JointVector& joint_rad) const;

  /// Sum of all link lengths, offsets and slides of the table including the tool, at least 1 mm. The rounding
  /// errors of the forward kinematics are proportional to this length.
  [[nodiscard]] double reach_m() const { return reach_m_; }
  /// Chosen so that the motion length of a long arm is the sum of its link lengths.
  static constexpr double kMotion = 1.1;
  /// Length that makes rotation and translation comparable, at least 1 mm: kMotion times the root mean square
  /// of the tool motion per rad, over all joints and all their angles; for a prismatic joint, its travel. It
  /// depends only on the motion of the tool, not on the position of the base or the convention of the table.
  [[nodiscard]] double motion_length_m() const { return motion_length_m_; }
  /// The rows in the standard convention, regardless of the convention of the file.
  [[nodiscard]] const std::array<JointRow, kMaxJoints>& links() const { return row_; }
  [[nodiscard]] const Rigid& base() const { return base_; }  // B
  [[nodiscard]] const Rigid& tool() const { return tool_; }  // E
  [[nodiscard]] bool all_revolute() const { return all_revolute_; }

 private:
  // A = Rz(turns q + θ) Tz(slides q + d) Tx(a) Rx(α) Ry(β)
  struct Link {
    double turns, slides, theta_rad, d_m, a_m, cos_alpha, sin_alpha, cos_beta, sin_beta;
  };
  struct Frame;
  template <typename Visit>
  Rigid walk(const JointVector& joint_rad, const Visit& visit) const;
  Rigid forward_into(const JointVector& joint_rad, Jacobian& J) const;
  void read_rows(const RobotConfig& robot);
  void renew_rows();
  [[nodiscard]] double motion_m(const RobotConfig& robot) const;

  std::array<Link, kMaxJoints> link_{};
  std::array<JointRow, kMaxJoints> row_{};
  Rigid base_{}, tool_{};
  Rigid last_{};  // transformation after the last joint: Tz(d) Tx(a) Rx(α) of that joint, then the tool
  double reach_m_ = 0.0;
  double motion_length_m_ = 0.0;
  bool all_revolute_ = true;
  bool any_beta_ = false;
};

}  // namespace longreach
