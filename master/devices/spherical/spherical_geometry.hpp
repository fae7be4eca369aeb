#pragma once
// The angles of a 3-RRR spherical parallel mechanism: three legs of two curved links each, where all axes
// intersect in one centre. In leg i the motor turns the first link by θ about the base axis u. The middle
// axis w is at the angle alpha1 from u and alpha2 from the platform axis v = R v*:
//
//   w(θ) = cos(alpha1) u + cos θ w_cos + sin θ w_sin,   w_sin = u x w_cos,   |w_cos| = sin(alpha1)
//   w(θ) . R v* = cos(alpha2)
//
// The geometry is given either by four angles, with η = 0, 120, 240 degrees for the legs:
//   u  = (-sin η sin β1, cos η sin β1, -cos β1),   v* = (-sin η sin β2, cos η sin β2, cos β2),
//   w_cos = sin(alpha1) (-sin η cos β1, cos η cos β1, sin β1),
// or by the axes themselves; then w_cos is the component of w0 = w(0) perpendicular to u.
//
// The constructors throw GeometryError, which names the parameter, for a mechanism that cannot exist: a value
// is not finite, a link angle is outside (0, π), an axis is not a unit vector, alpha1 differs from the angle
// of w0, two legs have the same axes, the platform axes are collinear, or no orientation closes the loops.
// Base axes may coincide (coaxial motors).

#include <array>

#include "common/core/geometry_error.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct SphericalAngles {
  double alpha1 = 0.0;  // proximal link, (0, π)
  double alpha2 = 0.0;  // distal link, (0, π)
  double beta1 = 0.0;   // angle of the base axes from -z, [0, π]
  double beta2 = 0.0;   // angle of the platform axes from +z, (0, π)
};

struct SphericalAxes {
  double alpha1 = 0.0;
  double alpha2 = 0.0;
  Matrix3 u = Matrix3::Zero();   // rows: base axes, unit vectors
  Matrix3 v = Matrix3::Zero();   // rows: platform axes in the platform frame, unit vectors
  Matrix3 w0 = Matrix3::Zero();  // rows: middle axes at θ = 0, unit vectors
};

class SphericalGeometry {
 public:
  struct Leg {
    Vector3 u, v;                   // base axis; platform axis in the platform frame
    Vector3 w_axial, w_cos, w_sin;  // w(θ) = w_axial + cos θ w_cos + sin θ w_sin
  };

  explicit SphericalGeometry(const SphericalAngles& angles);
  explicit SphericalGeometry(const SphericalAxes& axes);

  [[nodiscard]] const Leg& leg(int i) const { return legs_[i]; }
  [[nodiscard]] double cos_alpha2() const { return cos_alpha2_; }
  [[nodiscard]] double sin_alpha1() const { return sin_alpha1_; }
  [[nodiscard]] double sin_alpha2() const { return sin_alpha2_; }
  /// Returns w(θ) of leg i, a unit vector in the base frame.
  [[nodiscard]] Vector3 middle_axis(int i, double cos_theta, double sin_theta) const {
    const Leg& l = legs_[i];
    return l.w_axial + cos_theta * l.w_cos + sin_theta * l.w_sin;
  }

 private:
  void set_links(double alpha1, double alpha2);
  void set_legs(const SphericalAxes& axes);
  void require_distinct_legs() const;
  void require_closed_loop() const;
  [[nodiscard]] double gap(const Quaternion& q) const;

  double alpha1_ = 0.0, alpha2_ = 0.0;
  double cos_alpha2_ = 0.0, sin_alpha1_ = 0.0, sin_alpha2_ = 0.0;
  std::array<Leg, 3> legs_{};
};

}  // namespace longreach
