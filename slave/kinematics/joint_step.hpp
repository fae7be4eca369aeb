#pragma once
// Computes the joint step that removes an error of the tool, by damped least squares:
//   (JᵀJ + μ I) Δq = Jᵀ e
// The angular rows of J and e are multiplied by a length, so that all rows are in m. The system is solved as
// L D Lᵀ without pivoting, which a positive definite matrix does not need.

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct JointStep {
  JointVector joint_rad;
  /// Minimum pivot of D without the damping: 0 where J loses rank; accurate to about 1e-15 of the maximum.
  double least_pivot_m2;
};

/// Returns the step for the given damping. If the minimum pivot is below `singular_m2`, a tenth of the
/// difference is added to the damping. `J` in SI units, `e_m` = [angular times length; linear].
JointStep damped_step(const Jacobian& J, double length_m, const Vector6& e_m, double damping_m2,
                      double singular_m2);

/// Returns the undamped step, limited to 0.1 rad. It uses an orthogonal decomposition of J, which keeps
/// digits that JᵀJ loses. Directions in which J is smaller than 1e-11 of its largest column are ignored.
JointVector newton_step(const Jacobian& J_m, const Vector6& e_m);

/// Returns the square root of the minimum pivot, divided by `length_m`: 0 at a singular pose, about 0.3 at a
/// well-conditioned one. `J` in SI units.
double conditioning(const Jacobian& J, double length_m);

/// For a pose at which J loses rank, returns the unit vector [angular times length; linear] that no joint
/// motion produces.
Vector6 lost_direction(const Jacobian& J, double length_m);

/// Returns the unit joint motion that moves the tool the least.
JointVector idle_motion(const Jacobian& J, double length_m);

}  // namespace longreach
