#pragma once
// Fast arc tangent, with a third of the instructions of the C library's atan2, for code that computes many
// angles per step: returns the angle of the direction (x, y) in (-π, π]. It uses one division, the reduction
// to |t| <= tan(π/8) by atan t = π/4 + atan((t - 1)/(t + 1)), and the polynomial of fdlibm's atan (Sun
// Microsystems 1993). The error is at most 2.5 units in the last place. Infinities and subnormal numbers are
// not supported. NaN gives NaN, and (0, 0) gives 0.

#include <cmath>
#include <cstddef>

namespace longreach {

/// Returns atan(t) for |t| <= tan(π/8).
inline double arc_tangent_of_small(double t) {
  const double z = t * t, w = z * z;
  const double even =
      z * (3.33333333333329318027e-01 +
           w * (1.42857142725034663711e-01 +
                w * (9.09088713343650656196e-02 +
                     w * (6.66107313738753120669e-02 +
                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double odd = w * (-1.99999999998764832476e-01 +
                          w * (-1.11111104054623557880e-01 +
                               w * (-7.69187620504482999495e-02 +
                                    w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return t - t * (even + odd);
}

inline double arc_tangent(double y, double x) {
  constexpr double kEighth = 0.41421356237309503;  // tan(π/8)
  constexpr double kQuarterPi = 7.85398163397448278999e-01, kQuarterPiLow = 3.06161699786838301793e-17;
  constexpr double kPi = 3.14159265358979311600e+00, kPiLow = 1.22464679914735317636e-16;
  const double ax = std::abs(x), ay = std::abs(y);
  const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  if (large == 0.0) return 0.0;
  const bool far = small > kEighth * large;
  const double t = far ? (small - large) / (small + large) : small / large;
  double angle = arc_tangent_of_small(t);
  if (far) angle = kQuarterPi + (angle + kQuarterPiLow);
  if (ay > ax) angle = 2.0 * kQuarterPi - (angle - 2.0 * kQuarterPiLow);
  if (std::signbit(x)) angle = kPi - (angle - kPiLow);
  return std::copysign(angle, y);
}

/// Returns the angle in (-π/2, π/2) with the sine s, for |s| <= kSmallSine. Uses a Taylor series that is
/// accurate to rounding.
constexpr double kSmallSine = 0.1;
inline double arc_of_small_sine(double s) {
  const double z = s * s;
  return s + s * z *
                 (1.0 / 6.0 +
                  z * (3.0 / 40.0 + z * (5.0 / 112.0 +
                                         z * (35.0 / 1152.0 + z * (63.0 / 2816.0 + z * (231.0 / 13312.0))))));
}

/// Computes the angles of several directions at once, without branches: two directions take as long as one.
template <std::size_t n>
inline void arc_tangents(const double (&y)[n], const double (&x)[n], double (&angle)[n]) {
  constexpr double kEighth = 0.41421356237309503, kTiny = 1e-300;
  constexpr double kQuarterPi = 7.85398163397448278999e-01, kPi = 3.14159265358979311600e+00;
  for (std::size_t i = 0; i < n; ++i) {
    const double ax = std::abs(x[i]), ay = std::abs(y[i]);
    const double large = (ax > ay ? ax : ay) + kTiny, small = ax > ay ? ay : ax;
    const bool far = small > kEighth * large, steep = ay > ax, back = x[i] < 0.0;
    const double t = (small - (far ? large : 0.0)) / (large + (far ? small : 0.0));
    const double eighth = (far ? kQuarterPi : 0.0) + arc_tangent_of_small(t);
    const double quarter = (steep ? 2.0 * kQuarterPi : 0.0) + (steep ? -eighth : eighth);
    angle[i] = std::copysign((back ? kPi : 0.0) + (back ? -quarter : quarter), y[i]);
  }
}

}  // namespace longreach
