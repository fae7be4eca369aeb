#include "slave/robot/joint_step.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

Jacobian in_metres(const Jacobian& J, double length_m) {
  Jacobian J_m = J;
  J_m.topRows<3>() *= length_m;
  return J_m;
}

// JᵀJ, lower half.
Matrix6 normal_matrix(const Jacobian& J) {
  Matrix6 A;
  for (int k = 0; k < 6; ++k) {
    for (int i = k; i < 6; ++i) A(i, k) = J.col(i).dot(J.col(k));
  }
  return A;
}

}  // namespace

double solve_symmetric(Matrix6 A, JointVector& x) {
  double least = A(0, 0);
  JointVector inverse_pivot;
  for (int k = 0; k < 6; ++k) {
    least = std::min(least, A(k, k));
    inverse_pivot[k] = 1.0 / A(k, k);
    for (int i = k + 1; i < 6; ++i) {
      const double factor = A(i, k) * inverse_pivot[k];
      for (int j = i; j < 6; ++j) A(j, i) -= factor * A(j, k);
      x[i] -= factor * x[k];
    }
  }
  for (int k = 5; k >= 0; --k) {
    x[k] *= inverse_pivot[k];
    for (int i = k + 1; i < 6; ++i) x[k] -= A(i, k) * inverse_pivot[k] * x[i];
  }
  return least;
}

JointStep damped_step(const Jacobian& J_m, const Vector6& e_m, double damping_m2, double singular_m2) {
  const JointVector gradient = J_m.transpose() * e_m;
  Matrix6 normal = normal_matrix(J_m);
  normal.diagonal().array() += damping_m2;
  JointVector step = gradient;
  const double least = std::max(solve_symmetric(normal, step) - damping_m2, 0.0);
  if (!(least >= singular_m2)) {
    normal.diagonal().array() += 0.1 * (singular_m2 - least);
    step = gradient;
    solve_symmetric(normal, step);
  }
  return {step, least};
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
  // Column by column of L, with the angular rows weighed as the products are added up.
  const double weight = length_m * length_m;
  double A[6][6];
  for (int k = 0; k < 6; ++k) {
    const double* b = J.col(k).data();
    const double wx = weight * b[0], wy = weight * b[1], wz = weight * b[2];
    for (int i = k; i < 6; ++i) {
      const double* a = J.col(i).data();
      A[k][i] = wx * a[0] + wy * a[1] + wz * a[2] + b[3] * a[3] + b[4] * a[4] + b[5] * a[5];
    }
  }
  double least = A[0][0];
  for (int k = 0; k < 5; ++k) {
    const double inverse_pivot = 1.0 / A[k][k];
    for (int j = k + 1; j < 6; ++j) {
      const double factor = A[k][j] * inverse_pivot;
      for (int i = j; i < 6; ++i) A[j][i] -= factor * A[k][i];
    }
    least = std::min(least, A[k + 1][k + 1]);
  }
  return std::sqrt(std::max(least, 0.0)) / length_m;
}

namespace {

// The eigenvector of the least eigenvalue of J Jᵀ or Jᵀ J.
Vector6 least_direction(Matrix6 A, double length_m) {
  constexpr int kIterations = 4;      // of inverse iteration; each gains the ratio of two singular values
  constexpr double kDamping = 1e-14;  // of the reach squared: above rounding, below what is not lost
  A.diagonal().array() += kDamping * length_m * length_m;
  Vector6 direction = Vector6::Ones();
  for (int i = 0; i < kIterations; ++i) {
    solve_symmetric(A, direction);
    direction.normalize();
  }
  return direction;
}

}  // namespace

Vector6 lost_direction(const Jacobian& J, double length_m) {
  const Jacobian J_m = in_metres(J, length_m);
  return least_direction(J_m * J_m.transpose(), length_m);
}

JointVector idle_motion(const Jacobian& J, double length_m) {
  return least_direction(normal_matrix(in_metres(J, length_m)), length_m);
}

}  // namespace longreach
