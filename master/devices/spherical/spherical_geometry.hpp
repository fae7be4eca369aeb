#pragma once
// The angles of a 3-RRR spherical parallel mechanism: three legs of two curved links, all axes through one
// centre. Leg i turns its first link by θ about the base axis u; its middle axis w is alpha1 from u and
// alpha2 from the platform axis v = R v*:
//
//   w(θ) = cos(alpha1) u + cos θ w_cos + sin θ w_sin,   w_sin = u x w_cos,   |w_cos| = sin(alpha1)
//   w(θ) . R v* = cos(alpha2)
//
// From four angles, with η = 0, 120, 240 degrees: u = (-sin η sin β1, cos η sin β1, -cos β1),
// v* = (-sin η sin β2, cos η sin β2, cos β2), w_cos = sin(alpha1) (-sin η cos β1, cos η cos β1, sin β1). Or
// from the axes themselves: w_cos is the part of w0 = w(0) across u.
//
// The constructors throw GeometryError, which names the parameter, for an impossible mechanism: a value that
// is not finite, a link angle outside (0, π), axes that are not unit vectors, an alpha1 that differs from the
// angle of w0, two legs with the same axes, collinear platform axes, a loop that no orientation closes. Base
// axes may coincide (coaxial motors).

#include <array>

#include "common/core/geometry_error.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct SphericalAngles {
  double alpha1 = 0.0;  // proximal link, (0, π)
  double alpha2 = 0.0;  // distal link, (0, π)
  double beta1 = 0.0;   // base axes from -z, [0, π]
  double beta2 = 0.0;   // platform axes from +z, (0, π)
};

struct SphericalAxes {
  double alpha1 = 0.0;
  double alpha2 = 0.0;
  Matrix3 u = Matrix3::Zero();   // rows: base axes, unit
  Matrix3 v = Matrix3::Zero();   // rows: platform axes in the platform frame, unit
  Matrix3 w0 = Matrix3::Zero();  // rows: middle axes at θ = 0, unit
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
