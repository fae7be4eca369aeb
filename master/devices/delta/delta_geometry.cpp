#include "master/devices/delta/delta_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace longreach {
namespace {

constexpr double kSameAzimuth = 1e-3;  // |sin| of the angle below which two legs count as the same

double positive(std::string_view name, double value) {
  if (!(require_finite(name, value) > 0.0))
    throw GeometryError(std::string(name) + " is a length and must be positive");
  return value;
}

double not_negative(std::string_view name, double value) {
  if (require_finite(name, value) < 0.0)
    throw GeometryError(std::string(name) + " is a length and must not be negative");
  return value;
}

}  // namespace

// A negative base radius describes the same device with the azimuths turned by 180 degrees and θ counted from
// the other side.
DeltaGeometry::DeltaGeometry(const DeltaSimple& simple)
    : arm_(positive("l1", simple.l1)),
      rod_(positive("l2", simple.l2)),
      offset_(0.0),
      radius_(not_negative("a", simple.a)),
      side_(0.0),
      up_(-1.0) {
  place_legs(simple.azimuth_rad);
  require_closed_loop();
}

DeltaGeometry::DeltaGeometry(const DeltaGeneral& general)
    : arm_(positive("a", general.a)),
      rod_(positive("b", general.b)),
      offset_(not_negative("d", general.d) + not_negative("e", general.e)),
      radius_(require_finite("r", general.r) - require_finite("c", general.c)),
      side_(require_finite("s", general.s) - require_finite("f", general.f)),
      up_(1.0) {
  place_legs(general.azimuth_rad);
  require_closed_loop();
}

DeltaGeometry::DeltaGeometry(const DeltaDimensions& d)
    : arm_(positive("arm_m", d.arm_m)),
      rod_(positive("rod_m", d.rod_m)),
      offset_(not_negative("offset_m", d.offset_m)),
      radius_(require_finite("radius_m", d.radius_m)),
      side_(require_finite("side_m", d.side_m)),
      up_(d.upwards ? 1.0 : -1.0) {
  place_legs(d.azimuth_rad);
  require_closed_loop();
}

void DeltaGeometry::place_legs(const std::array<double, 3>& azimuth_rad) {
  for (int i = 0; i < 3; ++i) {
    require_finite("azimuth", azimuth_rad[i]);
    cos_[i] = std::cos(azimuth_rad[i]);
    sin_[i] = std::sin(azimuth_rad[i]);
  }
  cos_[3] = cos_[0], sin_[3] = sin_[0];
  double turn = 0.0;  // twice the area of the triangle of the three directions, positive if counterclockwise
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double sine = cos_[i] * sin_[j] - sin_[i] * cos_[j];
    const double cosine = cos_[i] * cos_[j] + sin_[i] * sin_[j];
    if (std::abs(sine) < kSameAzimuth && cosine > 0.0)
      throw GeometryError("azimuth: legs " + std::to_string(std::min(i, j) + 1) + " and " +
                          std::to_string(std::max(i, j) + 1) + " coincide");
    turn += sine;
  }
  working_ = turn * up_ > 0.0 ? DeltaAssembly::kPositive : DeltaAssembly::kNegative;
}

/// Returns the distance, m, by which the worst leg fails to reach p; not positive if all legs reach it.
double DeltaGeometry::gap(const Vector3& p) const {
  double worst = -size_m();
  for (int i = 0; i < 3; ++i) {
    const Vector3 q = to_leg(i, p) - Vector3(radius_, side_, 0.0);
    const double beside = std::abs(q.y()) - rod_;
    const double reach = offset_ + std::sqrt(std::max(-beside * (std::abs(q.y()) + rod_), 0.0));
    const double distance = std::hypot(q.x(), q.z());
    worst = std::max({worst, beside, distance - arm_ - reach, std::abs(arm_ - reach) - distance});
  }
  return worst;
}

/// Searches for one pose that all legs reach: on a coarse grid, and then in shrinking neighbourhoods of its
/// best points.
void DeltaGeometry::require_closed_loop() const {
  constexpr int kHalf = 8;
  const double span = std::abs(radius_) + std::abs(side_) + size_m();
  if (!std::isfinite(span * span)) throw GeometryError("the lengths are too large");
  // The positions where devices are used are tried first, which makes the search unnecessary for almost all
  // of them.
  for (int k = -kHalf; k <= kHalf; ++k) {
    if (gap({0.0, 0.0, span / kHalf * k}) <= 0.0) return;
  }
  Vector3 best = Vector3::Zero();
  double least = gap(best);
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vector3 p = span / kHalf * Vector3(i, j, k);
        const double g = gap(p);
        if (g <= 0.0) return;
        if (g < least) least = g, best = p;
      }
    }
  }
  for (double step = span / kHalf; step > 1e-12 * span;) {
    Vector3 next = best;
    for (int n = 0; n < 27; ++n) {
      const Vector3 p = best + step * Vector3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const double g = gap(p);
      if (g <= 0.0) return;
      if (g < least) least = g, next = p;
    }
    if (next == best) step *= 0.5;
    best = next;
  }
  throw GeometryError(
      "impossible geometry: there is no position of the platform that all three legs can reach");
}

}  // namespace longreach
