#pragma once
// Rows of Denavit and Hartenberg for a chain of joint axes, whatever frames it was described in:
//   X_WE = B A₁(q₁) ... Aₙ(qₙ) E,  A = Rz(q + θ) Tz(d) Tx(a) Rx(α) Ry(β)
// Between axes that are far from parallel a row follows the common normal, β = 0 (Denavit,
// Hartenberg 1955). The common normal of parallel axes is anywhere, that of nearly parallel ones far away:
// there the next frame is where the plane through this origin, normal to this axis, cuts the next axis;
// d = 0, and β takes what α leaves of the direction (Hayati 1983). So no length of a row is much greater
// than the arm.

#include <span>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Axis of a joint, where all joints are at zero. In W.
struct JointAxis {
  Vector3 point_m = Vector3::Zero();     // of a revolute joint: a point on the axis
  Vector3 direction = Vector3::UnitZ();  // unit
  bool slides = false;
};

struct JointRow {
  double a_m = 0.0, alpha_rad = 0.0, beta_rad = 0.0, d_m = 0.0, theta_rad = 0.0;
};

/// Tz(d) Tx(a) Rx(α) Ry(β): what follows the joint. Sines and cosines below 4e-16 count as zero: a right
/// angle in a file is meant exactly.
Matrix3 rotation_behind(const JointRow& row);

struct JointRows {
  Pose base{};  // B, in W
  std::vector<JointRow> row{};
  Pose tool{};  // E, in the frame of the last row
};

/// `axes`: at least one, directions of length 1; `X_WE`: the tool with all joints at zero. Exact to rounding.
JointRows joint_rows(std::span<const JointAxis> axes, const Pose& X_WE);

}  // namespace longreach
