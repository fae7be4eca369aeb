#include <cmath>
#include <limits>

#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

/// E cos θ + F sin θ + G = 0, D² = E² + F² - G².
struct SphericalLegLoop {
  double E = 0.0, F = 0.0, G = 0.0, D = 0.0;
  bool closes = false;
  bool double_root = false;

  // Returns the root with u . (w x v) = F cos θ - E sin θ >= 0 if `side` is +1, and <= 0 if it is -1.
  [[nodiscard]] double root(double side) const {
    const double y = -G * F - side * E * D, x = -G * E + side * F * D;
    return x == 0.0 && y == 0.0 ? 0.0 : std::atan2(y, x);
  }
};

SphericalLegLoop leg_loop(const SphericalGeometry& g, int i, const Vector3& v) {
  const SphericalGeometry::Leg& l = g.leg(i);
  SphericalLegLoop leg;
  leg.E = l.w_cos.dot(v);
  leg.F = l.w_sin.dot(v);
  leg.G = l.w_axial.dot(v) - g.cos_alpha2();
  const double h = std::sqrt(leg.E * leg.E + leg.F * leg.F);
  const double D2 = (h - leg.G) * (h + leg.G);
  // Possible effect of rounding of G and h on D²; all terms are at most 1.
  const double slack = 16.0 * std::numeric_limits<double>::epsilon() * (h + std::abs(leg.G) + 1e-15);
  leg.closes = D2 >= -slack;
  leg.double_root = D2 <= slack;
  leg.D = D2 > 0.0 ? std::sqrt(D2) : 0.0;
  return leg;
}

bool is_unit(const Quaternion& q) { return std::abs(q.squaredNorm() - 1.0) <= 1e-6; }

}  // namespace

SphericalMotors SphericalKinematics::inverse(const Quaternion& q, unsigned mode) const {
  if (!is_unit(q)) return {};
  const Matrix3 R = q.normalized().toRotationMatrix();
  SphericalMotors result;
  bool singular = false;
  for (int i = 0; i < 3; ++i) {
    const SphericalLegLoop leg = leg_loop(g_, i, R * g_.leg(i).v);
    if (!leg.closes) return {};
    singular |= leg.double_root;
    result.theta_rad[i] = leg.root((mode >> i & 1U) != 0 ? -1.0 : 1.0);
  }
  result.status = singular ? SolutionStatus::kSingular : SolutionStatus::kFound;
  return result;
}

SphericalRoots SphericalKinematics::inverse_all(const Quaternion& q) const {
  if (!is_unit(q)) return {};
  const Matrix3 R = q.normalized().toRotationMatrix();
  SphericalRoots result;
  bool singular = false;
  for (int i = 0; i < 3; ++i) {
    const SphericalLegLoop leg = leg_loop(g_, i, R * g_.leg(i).v);
    if (!leg.closes) return {};
    singular |= leg.double_root;
    result.first_rad[i] = leg.root(1.0);
    result.second_rad[i] = leg.root(-1.0);
  }
  result.status = singular ? SolutionStatus::kSingular : SolutionStatus::kFound;
  return result;
}

}  // namespace longreach
