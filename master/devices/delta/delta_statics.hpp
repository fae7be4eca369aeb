#pragma once
// Velocities and forces of a DELTA at a closed pose (θ, P). With the unit rods n_i = (P - K_i)/rod, K the
// forearm's end, and the levers l_i = n_i . dK_i/dθ_i:
//
//   n_i . v = l_i θ'_i,   v = J θ',   τ = Jᵀ F         (F on the hand by the device, τ by the motors)
//   τ_gravity = dU/dθ,  U = -g . (m_p P + Σ m_a (S_i + ρ A_i) + ½ m_f (S_i + A_i) + ½ m_f P)
//
// A is the vector of the arm and S its motor; half of each forearm is lumped at either end. τ_gravity is the
// torque that holds the device still. Angles and position must belong together, which is not checked here.

#include "common/core/solution_status.hpp"
#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// Distances from singularity, in [0, 1]; 0 is singular.
struct DeltaSingularity {
  double arm =
      0.0;  // type 1: least |l_i| / arm, arm and forearm in line: edge of the workspace, a force is lost
  double rods =
      0.0;  // type 2: least singular value of the three unit rods: a motion is not held by any motor
};

struct DeltaVelocity {
  Matrix3 rods = Matrix3::Zero();     // rows n_i, unit, in the base frame
  Vector3 lever_m = Vector3::Zero();  // l_i, m
};

/// kFound: the matrix. kSingular: the rods are dependent, and the matrix is zero.
struct DeltaJacobian {
  SolutionStatus status = SolutionStatus::kSingular;
  Matrix3 m_per_rad = Matrix3::Zero();
};

struct DeltaMasses {
  double platform_kg = 0.0;       // platform and handle, >= 0
  double arm_kg = 0.0;            // each arm, >= 0
  double arm_com_fraction = 0.5;  // its centre of mass along the arm from the motor, -1 to 1
  double forearm_kg = 0.0;        // each pair of rods, >= 0
};
/// Throws GeometryError, which names the field, for a negative mass or a value that is not finite or out of
/// range.
void require_valid(const DeltaMasses& masses);

/// kFound: the torques, N m. kSingular: zero.
struct DeltaTorques {
  SolutionStatus status = SolutionStatus::kSingular;
  Vector3 tau_nm = Vector3::Zero();
};

DeltaVelocity velocity(const DeltaGeometry& g, const Vector3& theta_rad, const Vector3& p_m);
DeltaSingularity singularity(const DeltaGeometry& g, const DeltaVelocity& at);
DeltaJacobian jacobian(const DeltaVelocity& at);

/// Returns the motor torques with which the device pushes with `force_n`.
DeltaTorques statics(const DeltaVelocity& at, const Vector3& force_n);

/// Returns the motor torques that compensate the weight of the device.
DeltaTorques gravity_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at);

/// Returns the sum of both: pushes with `force_n` and compensates the weight.
DeltaTorques holding_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at, const Vector3& force_n);

/// Potential energy of the device, J; zero with all masses at the origin of the base frame.
double potential_energy(const DeltaGeometry& g, const DeltaMasses& masses, const Vector3& gravity_m_per_s2,
                        const Vector3& theta_rad, const Vector3& p_m);

}  // namespace longreach
