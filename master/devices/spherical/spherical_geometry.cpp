#include "master/devices/spherical/spherical_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace longreach {
namespace {

constexpr double kGiven = 1e-6;      // tolerance of the length and the angle of given axes
constexpr double kSameAxis = 1e-3;   // rad
constexpr double kLeastLink = 1e-3;  // minimum distance of a link angle from 0 and from π, rad

double link(std::string_view name, double angle) {
  require_finite(name, angle);
  if (!(angle >= kLeastLink && angle <= std::numbers::pi - kLeastLink))
    throw GeometryError(std::string(name) + " must be between 0 and pi");
  return angle;
}

double cone(std::string_view name, double angle) {
  require_finite(name, angle);
  if (!(angle >= 0.0 && angle <= std::numbers::pi))
    throw GeometryError(std::string(name) + " must be from 0 to pi");
  return angle;
}

Vector3 unit_row(std::string_view name, const Matrix3& rows, int i) {
  const Vector3 row = rows.row(i);
  const std::string axis = std::string(name) + ", row " + std::to_string(i + 1);
  if (!row.allFinite()) throw GeometryError(axis + " is not finite");
  if (!(std::abs(row.norm() - 1.0) <= kGiven)) throw GeometryError(axis + " is not a unit vector");
  return row.normalized();
}

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

SphericalAxes axes_of(const SphericalAngles& angles) {
  const double s1 = std::sin(cone("beta1", angles.beta1)), c1 = std::cos(angles.beta1);
  const double s2 = std::sin(cone("beta2", angles.beta2)), c2 = std::cos(angles.beta2);
  SphericalAxes axes{angles.alpha1, angles.alpha2, {}, {}, {}};
  const double half_root3 = 0.5 * std::numbers::sqrt3;
  const std::array<double, 3> sines{0.0, half_root3, -half_root3}, cosines{1.0, -0.5, -0.5};
  for (int i = 0; i < 3; ++i) {
    const double s = sines[i], c = cosines[i];
    const Vector3 u(-s * s1, c * s1, -c1);
    axes.u.row(i) = u;
    axes.v.row(i) = Vector3(-s * s2, c * s2, c2);
    axes.w0.row(i) = std::cos(angles.alpha1) * u + std::sin(angles.alpha1) * Vector3(-s * c1, c * c1, s1);
  }
  return axes;
}

}  // namespace

SphericalGeometry::SphericalGeometry(const SphericalAngles& angles) {
  set_links(angles.alpha1, angles.alpha2);
  set_legs(axes_of(angles));
}

SphericalGeometry::SphericalGeometry(const SphericalAxes& axes) {
  set_links(axes.alpha1, axes.alpha2);
  set_legs(axes);
}

void SphericalGeometry::set_links(double alpha1, double alpha2) {
  alpha1_ = link("alpha1", alpha1);
  alpha2_ = link("alpha2", alpha2);
  sin_alpha1_ = std::sin(alpha1);
  sin_alpha2_ = std::sin(alpha2);
  cos_alpha2_ = std::cos(alpha2);
}

void SphericalGeometry::set_legs(const SphericalAxes& axes) {
  for (int i = 0; i < 3; ++i) {
    Leg& l = legs_[i];
    l.u = unit_row("u", axes.u, i);
    l.v = unit_row("v", axes.v, i);
    const Vector3 w0 = unit_row("w0", axes.w0, i);
    if (!(std::abs(angle_between(l.u, w0) - alpha1_) <= 4.0 * kGiven))
      throw GeometryError("alpha1 is not the angle between u and w0 of leg " + std::to_string(i + 1));
    const Vector3 across = w0 - w0.dot(l.u) * l.u;
    l.w_axial = std::cos(alpha1_) * l.u;
    l.w_cos = sin_alpha1_ * across.normalized();
    l.w_sin = l.u.cross(l.w_cos);
  }
  require_distinct_legs();
  require_closed_loop();
}

void SphericalGeometry::require_distinct_legs() const {
  bool in_line = true;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const bool same_v = angle_between(legs_[i].v, legs_[j].v) < kSameAxis;
    if (same_v && angle_between(legs_[i].u, legs_[j].u) < kSameAxis)
      throw GeometryError("legs " + std::to_string(std::min(i, j) + 1) + " and " +
                          std::to_string(std::max(i, j) + 1) + " coincide");
    in_line &= legs_[i].v.cross(legs_[j].v).norm() < kSameAxis;
  }
  if (in_line)
    throw GeometryError("beta2 or v: the platform axes are collinear, so the platform turns freely");
}

/// Returns the angle, rad, by which the worst leg fails to reach the orientation q; not positive if all legs
/// reach it.
double SphericalGeometry::gap(const Quaternion& q) const {
  const double least = std::abs(alpha1_ - alpha2_);
  const double most = std::min(alpha1_ + alpha2_, 2.0 * std::numbers::pi - alpha1_ - alpha2_);
  double worst = -std::numbers::pi;
  for (const Leg& l : legs_) {
    const double angle = angle_between(l.u, q * l.v);
    worst = std::max({worst, least - angle, angle - most});
  }
  return worst;
}

/// Searches for one orientation that all legs reach: among rotations spread over all directions and angles,
/// and then in shrinking neighbourhoods of the best of them.
void SphericalGeometry::require_closed_loop() const {
  constexpr int kSamples = 4000;
  Quaternion best = Quaternion::Identity();
  double least = gap(best);
  for (int n = 0; n < kSamples && least > 0.0; ++n) {
    // Shoemake's uniform rotations from an additive (Kronecker) sequence of three numbers.
    const double a = std::fmod(0.8191725134 * n, 1.0), b = std::fmod(0.6710436067 * n, 1.0),
                 c = std::fmod(0.5497004779 * n, 1.0);
    const double turn = 2.0 * std::numbers::pi, r1 = std::sqrt(1.0 - a), r2 = std::sqrt(a);
    const Quaternion q(r2 * std::cos(turn * c), r1 * std::sin(turn * b), r1 * std::cos(turn * b),
                       r2 * std::sin(turn * c));
    const double g = gap(q);
    if (g < least) least = g, best = q;
  }
  for (double step = 0.2; step > 1e-12 && least > 0.0;) {
    Quaternion next = best;
    bool better = false;
    for (int n = 0; n < 27; ++n) {
      const Quaternion q = exp_rotation(step * Vector3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) * best;
      const double g = gap(q);
      if (g < least) least = g, next = q, better = true;
    }
    if (!better) step *= 0.5;
    best = next;
  }
  if (least > 0.0)
    throw GeometryError("impossible geometry: there is no orientation that all three legs can reach");
}

}  // namespace longreach
