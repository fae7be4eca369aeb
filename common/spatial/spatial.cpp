#include "common/spatial/spatial.hpp"

#include <cmath>

#include "common/spatial/arc_tangent.hpp"
#include "common/spatial/sin_cos.hpp"

namespace longreach {

Quaternion exp_rotation(const Vector3& rotation_rad) {
  const double angle = norm(rotation_rad);
  const auto [sine, cosine] = sin_cos(0.5 * angle);
  // sin(half)/angle by its series where the quotient would lose digits.
  const double s = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : sine / angle;
  return {cosine, s * rotation_rad.x(), s * rotation_rad.y(), s * rotation_rad.z()};
}

Vector3 log_rotation(const Quaternion& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // the shorter way round
  const Vector3 v = sign * q.vec();
  const double s = norm(v);
  return s < 1e-10 ? Vector3(2.0 * v) : Vector3(v * (2.0 * arc_tangent(s, std::abs(q.w())) / s));
}

}  // namespace longreach
