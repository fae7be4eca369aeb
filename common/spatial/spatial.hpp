#pragma once
// Poses, twists, wrenches and the exponential coordinates of rotations. Frames: W slave world, M master base,
// H handle, S robot base, E tool, F force sensor, C contact. X_AB is the pose of B in A, V_AB a twist
// [angular; linear], and F_E_W the wrench [moment; force] at E, expressed in W, that the environment exerts
// on the tool.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace longreach {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

struct Pose {
  Vector3 p = Vector3::Zero();            // position, m
  Quaternion q = Quaternion::Identity();  // orientation, unit quaternion
};

inline bool is_finite(const Pose& X) { return X.p.allFinite() && X.q.coeffs().allFinite(); }

struct Twist {
  Vector3 angular = Vector3::Zero();  // rad/s
  Vector3 linear = Vector3::Zero();   // m/s
};

struct Wrench {
  Vector3 moment = Vector3::Zero();  // N m
  Vector3 force = Vector3::Zero();   // N
};

/// Returns the Euclidean norm. The slower scaled computation is used only if the square is out of range.
inline double norm(const Vector3& v) {
  const double square = v.squaredNorm();
  if (square > 1e-200 && square < 1e200) return std::sqrt(square);
  return v.isZero(0.0) ? 0.0 : v.stableNorm();
}

/// Returns the cross-product matrix [v]×, for which [v]× w = v × w.
inline Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Converts a rotation vector (axis times angle, rad) to a unit quaternion. The result is exact at zero and
/// valid for every finite vector.
Quaternion exp_rotation(const Vector3& rotation_rad);

/// Converts a unit quaternion to the shortest rotation vector, |result| <= pi. The result is accurate near
/// zero and near pi.
Vector3 log_rotation(const Quaternion& q);

/// Composes two poses: X_AC = X_AB * X_BC.
inline Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.p + X_AB.q * X_BC.p, (X_AB.q * X_BC.q).normalized()};
}

inline Pose inverse(const Pose& X_AB) {
  const Quaternion q = X_AB.q.conjugate();
  return {-(q * X_AB.p), q};
}

/// Returns `v`, shortened to the length `limit` (>= 0) if it is longer. The direction is kept.
inline Vector3 clamp_norm(const Vector3& v, double limit) {
  const double n = norm(v);
  return n > limit ? Vector3(v * (limit / n)) : v;
}

}  // namespace longreach
