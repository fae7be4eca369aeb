#pragma once
// Velocities and torques of a 3-RRR spherical mechanism at a closed pose (θ, R):
//
//   (w_i x v_i) . ω = (u_i . (w_i x v_i)) θ'_i,   θ' = J ω,   M = Jᵀ τ
//   (M on the hand by the device, τ by the motors)
//
// ω and M are in the base frame. Angles and orientation must belong to the same pose, which is not checked
// here.

#include "common/core/solution_status.hpp"
#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Distances from singularity, each in [0, 1]; 0 is singular.
struct SphericalSingularity {
  /// Type 1: minimum of |u . (w x v)| / (sin alpha1 sin alpha2). At zero, a leg is stretched or folded.
  double legs = 0.0;
  /// Type 2: smallest singular value of the three unit vectors along w x v. At zero, there is a rotation of
  /// the platform that no motor resists.
  double platform = 0.0;
};

struct SphericalVelocity {
  Matrix3 normals = Matrix3::Zero();  // rows (w_i x v_i) / sin(alpha2); unit vectors if the loops are closed
  Vector3 lever = Vector3::Zero();    // u_i . (w_i x v_i) / sin(alpha2)
};

/// kSingular: the matrix is zero, because it has no finite value.
struct SphericalJacobian {
  SolutionStatus status = SolutionStatus::kSingular;
  Matrix3 matrix = Matrix3::Zero();
};

/// A torque vector. kSingular: the vector is zero.
struct SphericalTorque {
  SolutionStatus status = SolutionStatus::kSingular;
  Vector3 nm = Vector3::Zero();
};

/// Returns the normals and levers at the pose (θ, R).
SphericalVelocity velocity(const SphericalGeometry& g, const Vector3& theta_rad, const Quaternion& q);
/// Returns the distances from singularity.
SphericalSingularity singularity(const SphericalGeometry& g, const SphericalVelocity& at);

/// Returns J, which maps the angular velocity of the handle to motor rates. It is singular at a type 1
/// singularity.
SphericalJacobian jacobian(const SphericalVelocity& at);
/// Returns J^-1, which maps motor rates to the angular velocity. It is singular at a type 2 singularity.
SphericalJacobian inverse_jacobian(const SphericalVelocity& at);

/// Returns the motor torques with which the device applies `moment_nm` to the hand: τ = J^-T M.
SphericalTorque statics(const SphericalVelocity& at, const Vector3& moment_nm);

}  // namespace longreach
