#pragma once
// Loop closure of one leg near a given orientation q0, as a function of g in q = (1, g) q0 (g = axis
// tan(angle/2)):
//   F(g) = (k - c)/2 + g . n + ...,   n = v x w,  k = w . v,  c = cos(alpha2)
// to first order (spherical_kinematics.hpp contains the remaining terms), and the linear algebra for three
// legs.

#include "common/spatial/spatial.hpp"

namespace longreach {

struct SphericalClosure {
  Vector3 w, v, n;
  double half_gap = 0.0;  // (k - c)/2

  SphericalClosure() = default;
  SphericalClosure(const Vector3& middle_axis, const Vector3& platform_axis, double c)
      : w(middle_axis), v(platform_axis), n(platform_axis.cross(middle_axis)) {
    half_gap = 0.5 * (w.dot(v) - c);
  }
};

/// Adjugate of the matrix with the rows a, b, c, whose inverse is [x y z] / volume.
struct Adjugate {
  Vector3 x, y, z;
  double volume = 0.0;

  Adjugate(const Vector3& a, const Vector3& b, const Vector3& c)
      : x(b.cross(c)), y(c.cross(a)), z(a.cross(b)), volume(a.dot(x)) {}

  [[nodiscard]] Vector3 times(double r1, double r2, double r3) const { return r1 * x + r2 * y + r3 * z; }
  /// Returns the squared Frobenius norm of the inverse, times volume².
  [[nodiscard]] double square() const { return x.squaredNorm() + y.squaredNorm() + z.squaredNorm(); }
};

/// Returns (1, g) q0, normalised.
inline Quaternion turned(const Vector3& g, const Quaternion& q0) {
  return (Quaternion(1.0, g.x(), g.y(), g.z()) * q0).normalized();
}

}  // namespace longreach
