#pragma once
// Poses, twists, wrenches and the exponential coordinates of rotations.
// Frames: W slave world, M master base, H handle, S robot base, E tool, F force sensor, C contact.
// X_AB is the pose of B in A; V_AB a twist [angular; linear]; F_E_W a wrench [moment; force] at E in W, by
// the environment on the tool.

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

/// Euclidean norm; the slower scaled computation is used only where the square is out of range.
inline double norm(const Vector3& v) {
  const double square = v.squaredNorm();
  if (square > 1e-200 && square < 1e200) return std::sqrt(square);
  return v.isZero(0.0) ? 0.0 : v.stableNorm();
}

/// [v]×, so that [v]× w = v × w.
inline Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Rotation vector (axis times angle, rad) to unit quaternion; exact at zero, valid for every finite vector.
Quaternion exp_rotation(const Vector3& rotation_rad);

/// Unit quaternion to the shortest rotation vector, |result| <= pi; accurate near zero and near pi.
Vector3 log_rotation(const Quaternion& q);

/// `a` composed with `b`: X_AC = X_AB * X_BC.
inline Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.p + X_AB.q * X_BC.p, (X_AB.q * X_BC.q).normalized()};
}

inline Pose inverse(const Pose& X_AB) {
  const Quaternion q = X_AB.q.conjugate();
  return {-(q * X_AB.p), q};
}

/// Returns `v` shortened to at most `limit` (>= 0); the direction is kept; a zero vector stays zero.
inline Vector3 clamp_norm(const Vector3& v, double limit) {
  const double n = norm(v);
  return n > limit ? Vector3(v * (limit / n)) : v;
}

}  // namespace longreach
