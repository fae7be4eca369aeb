#include "deploy/lab/devices/spherical_catalog.hpp"

#include <cmath>
#include <numbers>

namespace longreach {

SphericalGeometry reconstructed_spherical() {
  const double right = std::numbers::pi / 2.0;
  const double corner = std::atan(std::numbers::sqrt2);  // angle between an edge of a cube and its diagonal
  return SphericalGeometry(SphericalAngles{right, right, corner, corner});
}

SphericalGeometry agile_eye() {
  SphericalAxes axes{
      std::numbers::pi / 2.0, std::numbers::pi / 2.0, Matrix3::Identity(), Matrix3::Identity(), {}};
  axes.w0 << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  return SphericalGeometry(axes);
}

SphericalGeometry compact_spherical() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  return SphericalGeometry(SphericalAngles{60.0 * kDegree, 80.0 * kDegree, 50.0 * kDegree, 70.0 * kDegree});
}

}  // namespace longreach
