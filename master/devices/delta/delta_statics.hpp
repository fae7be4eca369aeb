#pragma once
// Velocities and forces of a DELTA at a closed pose (θ, P). K_i is the centre of the sphere of radius rod on
// which P lies for a given angle of leg i: the elbow end of the rods, shifted by the offset of the platform
// joint. With the unit vectors along the rods n_i = (P - K_i)/rod and the levers l_i = n_i . dK_i/dθ_i:
//
//   n_i . v = l_i θ'_i,   v = J θ',   τ = Jᵀ F         (F on the hand by the device, τ by the motors)
//   τ_gravity = dU/dθ,  U = -g . (m_p P + Σ m_a (S_i + ρ A_i) + ½ m_f (S_i + A_i) + ½ m_f P)
//
// A_i is the vector of the arm and S_i the position of its motor; half the mass of each forearm is lumped at
// either end. τ_gravity is the torque that holds the device at rest. Angles and position must belong to the
// same pose, which is not checked here.

#include "common/core/solution_status.hpp"
#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// Distances from singularity, each in [0, 1]; 0 is singular.
struct DeltaSingularity {
  /// Type 1: minimum of |l_i| / arm. At zero, arm and forearm are in line: the edge of the workspace, where the
  /// platform loses a degree of freedom.
  double arm = 0.0;
  /// Type 2: smallest singular value of the three unit vectors along the rods. At zero, there is a motion of
  /// the platform that no motor resists.
  double rods = 0.0;
};

struct DeltaVelocity {
  Matrix3 rods = Matrix3::Zero();     // rows n_i, unit vectors in the base frame
  Vector3 lever_m = Vector3::Zero();  // l_i, m
};

/// J of v = J θ'. kSingular: the rods are linearly dependent, and the matrix is zero.
struct DeltaJacobian {
  SolutionStatus status = SolutionStatus::kSingular;
  Matrix3 m_per_rad = Matrix3::Zero();
};

struct DeltaMasses {
  double platform_kg = 0.0;       // platform and handle, >= 0
  double arm_kg = 0.0;            // each arm, >= 0
  double arm_com_fraction = 0.5;  // centre of mass along the arm, from the motor, -1 to 1
  double forearm_kg = 0.0;        // each pair of rods, >= 0
};
/// Throws GeometryError, which names the field, if a mass is negative or a value is not finite or out of
/// range.
void require_valid(const DeltaMasses& masses);

/// Motor torques, N m. kSingular: the torques are zero.
struct DeltaTorques {
  SolutionStatus status = SolutionStatus::kSingular;
  Vector3 tau_nm = Vector3::Zero();
};

/// Returns the rod directions and levers at the pose (θ, P).
DeltaVelocity velocity(const DeltaGeometry& g, const Vector3& theta_rad, const Vector3& p_m);
/// Returns the distances from singularity.
DeltaSingularity singularity(const DeltaGeometry& g, const DeltaVelocity& at);
/// Returns J, which maps motor rates to the velocity of the platform.
DeltaJacobian jacobian(const DeltaVelocity& at);

/// Returns the motor torques with which the device applies the force `force_n` to the hand.
DeltaTorques statics(const DeltaVelocity& at, const Vector3& force_n);

/// Returns the motor torques that compensate the weight of the device.
DeltaTorques gravity_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at);

/// Returns the sum of statics() and gravity_torques().
DeltaTorques holding_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at, const Vector3& force_n);

/// Returns the potential energy of the device, J. It would be zero with all masses at the origin of the base
/// frame.
double potential_energy(const DeltaGeometry& g, const DeltaMasses& masses, const Vector3& gravity_m_per_s2,
                        const Vector3& theta_rad, const Vector3& p_m);

}  // namespace longreach
