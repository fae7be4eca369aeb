#include "common/spatial/spatial.hpp"

#include <cmath>

namespace longreach {

Quaternion exp_rotation(const Vector3& rotation_rad) {
  const double angle = rotation_rad.stableNorm();
  const double half = 0.5 * angle;
  // sin(half)/angle by its series where the quotient would lose digits.
  const double s = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  return Quaternion(std::cos(half), s * rotation_rad.x(), s * rotation_rad.y(), s * rotation_rad.z())
      .normalized();
}

Vector3 log_rotation(const Quaternion& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // the shorter way round
  const Vector3 v = sign * q.vec();
  const double s = v.stableNorm();
  const double angle = 2.0 * std::atan2(s, std::abs(q.w()));
  return s < 1e-10 ? Vector3(2.0 * v) : Vector3(v * (angle / s));
}

}  // namespace longreach
