#pragma once
// A rigid displacement as a rotation matrix and a translation, for products along chains of joints. Pose
// (common/spatial) represents the same displacement with a quaternion and is used in interfaces.

#include <cmath>

#include "common/spatial/arc_tangent.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct Rigid {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();  // m
};

inline Rigid operator*(const Rigid& a, const Rigid& b) { return {a.R * b.R, a.p + a.R * b.p}; }

inline Rigid inverse(const Rigid& a) {
  const Matrix3 R = a.R.transpose();
  return {R, -(R * a.p)};
}

inline Rigid to_rigid(const Pose& X) { return {X.q.toRotationMatrix(), X.p}; }
inline Pose to_pose(const Rigid& X) { return {X.p, Quaternion(X.R).normalized()}; }

/// Returns the shortest rotation vector from `from` to `to`; all are expressed in the same frame, in rad.
/// Accurate to rounding for small rotations.
inline Vector3 rotation_between(const Matrix3& from, const Matrix3& to) {
  const Vector3 w = 0.5 * (from.col(0).cross(to.col(0)) + from.col(1).cross(to.col(1)) +
                           from.col(2).cross(to.col(2)));  // axis times sine
  const double square = w.squaredNorm();
  const double cosine = 0.5 * (from.cwiseProduct(to).sum() - 1.0);
  constexpr double kSmall = 1e-8;
  if (square < kSmall) {
    if (cosine > 0.0) return w * (1.0 + square / 6.0);
    return log_rotation(Quaternion(Matrix3(to * from.transpose())).normalized());
  }
  const double sine = std::sqrt(square);
  return w * (arc_tangent(sine, cosine) / sine);
}

/// Like rotation_between(), but the vector has the length 2 sin(θ/2) instead of the angle θ. Its square is
/// half the squared Frobenius norm of the difference of the matrices, and it needs no arc tangent. Accurate
/// to 1e-7 near half a turn, and to rounding elsewhere.
inline Vector3 chord_between(const Matrix3& from, const Matrix3& to) {
  const Vector3 w =
      0.5 * (from.col(0).cross(to.col(0)) + from.col(1).cross(to.col(1)) + from.col(2).cross(to.col(2)));
  const double half = 0.25 * (from.cwiseProduct(to).sum() + 1.0);  // cos² θ/2
  constexpr double kTurned = 1e-9;
  if (half > kTurned) return w * (1.0 / std::sqrt(half));
  return clamp_norm(rotation_between(from, to), 2.0);
}

}  // namespace longreach
