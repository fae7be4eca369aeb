#pragma once
// Velocities and torques of a 3-RRR spherical mechanism at a closed pose (θ, R):
//
//   (w_i x v_i) . ω = (u_i . (w_i x v_i)) θ'_i,   θ' = J ω,   M = Jᵀ τ      (M on the hand by the device, τ
//   by the motors)
//
// ω and M are in the base frame. Angles and orientation must belong together, which is not checked here.

#include "common/core/solution_status.hpp"
#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Distances from singularity, in [0, 1]; 0 is singular.
struct SphericalSingularity {
  double legs = 0.0;  // type 1: least |u . (w x v)| / (sin alpha1 sin alpha2): a leg stretched or folded
  double platform =
      0.0;  // type 2: least singular value of the three unit (w x v): a turn is not held by any motor
};

struct SphericalVelocity {
  Matrix3 normals = Matrix3::Zero();  // rows (w_i x v_i) / sin(alpha2): unit where the loop is closed
  Vector3 lever = Vector3::Zero();    // u_i . (w_i x v_i) / sin(alpha2)
};

/// kFound: the matrix. kSingular: zero, because it has no finite value.
struct SphericalJacobian {
  SolutionStatus status = SolutionStatus::kSingular;
  Matrix3 matrix = Matrix3::Zero();
};

/// kFound: the vector. kSingular: zero.
struct SphericalTorque {
  SolutionStatus status = SolutionStatus::kSingular;
  Vector3 nm = Vector3::Zero();
};

SphericalVelocity velocity(const SphericalGeometry& g, const Vector3& theta_rad, const Quaternion& q);
SphericalSingularity singularity(const SphericalGeometry& g, const SphericalVelocity& at);

/// J: motor rates from the angular velocity of the handle. Singular in type 1.
SphericalJacobian jacobian(const SphericalVelocity& at);
/// J^-1: angular velocity from motor rates. Singular in type 2.
SphericalJacobian inverse_jacobian(const SphericalVelocity& at);

/// Returns the motor torques with which the device acts on the hand with `moment_nm`: τ = J^-T M.
SphericalTorque statics(const SphericalVelocity& at, const Vector3& moment_nm);

}  // namespace longreach
