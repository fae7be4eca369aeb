#include "slave/kinematics/joint_step.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

using Square = double[6][6];  // of a symmetric matrix the upper half, by rows

// JᵀJ with the angular rows weighed as the products are added up.
inline void normal_matrix(const Jacobian& J, double length_m, Square& A) {
  const double weight = length_m * length_m;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const double* b = J.col(k).data();
    const double wx = weight * b[0], wy = weight * b[1], wz = weight * b[2];
#pragma GCC unroll 6
    for (int i = k; i < 6; ++i) {
      const double* a = J.col(i).data();
      A[k][i] = wx * a[0] + wy * a[1] + wz * a[2] + b[3] * a[3] + b[4] * a[4] + b[5] * a[5];
    }
  }
}

// A = Uᵀ D⁻¹ U in place, D the diagonal of U: its inverse, and its least element.
inline double eliminate(Square& A, double (&inverse_pivot)[6]) {
  double least = A[0][0];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    least = std::min(least, A[k][k]);
    inverse_pivot[k] = 1.0 / A[k][k];
#pragma GCC unroll 6
    for (int j = k + 1; j < 6; ++j) {
      const double factor = A[k][j] * inverse_pivot[k];
#pragma GCC unroll 6
      for (int i = j; i < 6; ++i) A[j][i] -= factor * A[k][i];
    }
  }
  return least;
}

inline JointVector substitute(const Square& U, const double (&inverse_pivot)[6], JointVector x) {
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const double y = x[k] * inverse_pivot[k];
#pragma GCC unroll 6
    for (int j = k + 1; j < 6; ++j) x[j] -= U[k][j] * y;
  }
#pragma GCC unroll 6
  for (int k = 5; k >= 0; --k) {
#pragma GCC unroll 6
    for (int i = k + 1; i < 6; ++i) x[k] -= U[k][i] * x[i];
    x[k] *= inverse_pivot[k];
  }
  return x;
}

// With the damping given: the step, and the least pivot without the damping.
JointStep damped(const Square& normal, const JointVector& gradient, double damping_m2) {
  Square A;
  for (int k = 0; k < 6; ++k) {
    std::copy(normal[k] + k, normal[k] + 6, A[k] + k);
    A[k][k] += damping_m2;
  }
  double inverse_pivot[6];
  const double least = eliminate(A, inverse_pivot);
  return {substitute(A, inverse_pivot, gradient), std::max(least - damping_m2, 0.0)};
}

}  // namespace

JointStep damped_step(const Jacobian& J, double length_m, const Vector6& e_m, double damping_m2,
                      double singular_m2) {
  Square normal;
  normal_matrix(J, length_m, normal);
  Vector6 weighed = e_m;
  weighed.head<3>() *= length_m;
  const JointVector gradient = J.transpose() * weighed;
  const JointStep step = damped(normal, gradient, damping_m2);
  if (step.least_pivot_m2 >= singular_m2) return step;
  const double missing = 0.1 * (singular_m2 - step.least_pivot_m2);
  return {damped(normal, gradient, damping_m2 + missing).joint_rad, step.least_pivot_m2};
}

JointVector newton_step(const Jacobian& J_m, const Vector6& e_m) {
  constexpr double kLost = 1e-11, kStepMaxRad = 0.1;
  Eigen::ColPivHouseholderQR<Jacobian> decomposition;
  decomposition.setThreshold(kLost);
  decomposition.compute(J_m);
  const JointVector step = decomposition.solve(e_m);
  const double largest = step.cwiseAbs().maxCoeff();
  return largest > kStepMaxRad ? JointVector(step * (kStepMaxRad / largest)) : step;
}

double conditioning(const Jacobian& J, double length_m) {
  Square A;
  normal_matrix(J, length_m, A);
  double inverse_pivot[6];
  return std::sqrt(std::max(eliminate(A, inverse_pivot), 0.0)) / length_m;
}

namespace {

// The eigenvector of the least eigenvalue of J Jᵀ or Jᵀ J.
Vector6 least_direction(const Matrix6& symmetric, double length_m) {
  constexpr int kIterations = 4;      // of inverse iteration; each gains the ratio of two singular values
  constexpr double kDamping = 1e-14;  // of the reach squared: above rounding, below what is not lost
  Square A;
  for (int k = 0; k < 6; ++k) {
    for (int i = k; i < 6; ++i) A[k][i] = symmetric(i, k) + (i == k ? kDamping * length_m * length_m : 0.0);
  }
  double inverse_pivot[6];
  eliminate(A, inverse_pivot);
  Vector6 direction = Vector6::Ones();
  for (int i = 0; i < kIterations; ++i) direction = substitute(A, inverse_pivot, direction).normalized();
  return direction;
}

Jacobian in_metres(const Jacobian& J, double length_m) {
  Jacobian J_m = J;
  J_m.topRows<3>() *= length_m;
  return J_m;
}

}  // namespace

Vector6 lost_direction(const Jacobian& J, double length_m) {
  const Jacobian J_m = in_metres(J, length_m);
  return least_direction(J_m * J_m.transpose(), length_m);
}

JointVector idle_motion(const Jacobian& J, double length_m) {
  const Jacobian J_m = in_metres(J, length_m);
  return least_direction(J_m.transpose() * J_m, length_m);
}

}  // namespace longreach
