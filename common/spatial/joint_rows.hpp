#pragma once
// Computes Denavit-Hartenberg rows for a chain of joint axes, regardless of the frames that describe it:
//   X_WE = B A₁(q₁) ... Aₙ(qₙ) E,  A = Rz(q + θ) Tz(d) Tx(a) Rx(α) Ry(β)
// For axes that are far from parallel, a row follows their common normal, and β = 0 (Denavit, Hartenberg
// 1955). The common normal of parallel axes is not unique, and that of nearly parallel axes may be far away.
// In these cases the next origin is the point where the next axis intersects the plane through the current
// origin that is normal to the current axis; d = 0, and α and β together define the direction of the next
// axis (Hayati 1983). Therefore no length in a row is much greater than the length of the arm.

#include <span>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Axis of a joint in W while all joints are at zero.
struct JointAxis {
  Vector3 point_m = Vector3::Zero();     // a point on the axis; for a prismatic joint, its origin
  Vector3 direction = Vector3::UnitZ();  // unit vector
  bool slides = false;
};

struct JointRow {
  double a_m = 0.0, alpha_rad = 0.0, beta_rad = 0.0, d_m = 0.0, theta_rad = 0.0;
};

/// Returns the rotation of Tz(d) Tx(a) Rx(α) Ry(β), the part of a row that follows the joint. Sines and
/// cosines below 4e-16 are set to zero, because a right angle in a file is meant to be exact.
Matrix3 rotation_behind(const JointRow& row);

struct JointRows {
  Pose base{};  // B, in W
  std::vector<JointRow> row{};
  Pose tool{};  // pose of E in the frame of the last row
};

/// Computes the rows for at least one axis. `X_WE` is the pose of the tool with all joints at zero. The
/// result is exact except for rounding.
JointRows joint_rows(std::span<const JointAxis> axes, const Pose& X_WE);

}  // namespace longreach
