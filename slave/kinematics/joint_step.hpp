#pragma once
// The joint step that removes an error of the tool, by damped least squares:
//   (JᵀJ + μ I) Δq = Jᵀ e
// with the angular rows of J and e multiplied by a length, so that all of it is in m. Solved as L D Lᵀ
// without pivoting, which a positive definite matrix does not need.

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct JointStep {
  JointVector joint_rad;
  double
      /// minimum of D without the damping: 0 where J loses rank; accurate to about 1e-15 of the maximum
      least_pivot_m2;
};

/// With the given damping; if the minimum pivot is below `singular_m2`, plus a tenth of the difference. `J`
/// in SI, `e_m` [angular times length; linear].
JointStep damped_step(const Jacobian& J, double length_m, const Vector6& e_m, double damping_m2,
                      double singular_m2);

/// Undamped, by orthogonal decomposition of J, which keeps the digits that JᵀJ loses. Components that J moves
/// by less than 1e-11 of its largest column are ignored. At most 0.1 rad.
JointVector newton_step(const Jacobian& J_m, const Vector6& e_m);

/// Square root of the minimum pivot over `length_m`: 0 at a singular pose, about 0.3 at a good one. `J` in
/// SI.
double conditioning(const Jacobian& J, double length_m);

/// At a pose where J loses rank: the unit vector [angular times length; linear] that no joint motion
/// produces.
Vector6 lost_direction(const Jacobian& J, double length_m);

/// The unit joint motion that moves the tool least.
JointVector idle_motion(const Jacobian& J, double length_m);

}  // namespace longreach
