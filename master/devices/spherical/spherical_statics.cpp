#include "master/devices/spherical/spherical_statics.hpp"

#include <cmath>

#include "common/spatial/sin_cos.hpp"
#include "common/spatial/singular_value.hpp"
#include "master/devices/spherical/spherical_closure.hpp"

namespace longreach {
namespace {

/// Lever, or volume of the unit normals, below which it counts as zero.
constexpr double kDependentNormals = 1e-9;

}  // namespace

SphericalVelocity velocity(const SphericalGeometry& g, const Vector3& theta_rad, const Quaternion& q) {
  const Matrix3 R = q.toRotationMatrix();
  SphericalVelocity at;
  for (int i = 0; i < 3; ++i) {
    const auto [s, c] = sin_cos(theta_rad[i]);
    const Vector3 w = g.middle_axis(i, c, s);
    const Vector3 normal = w.cross(R * g.leg(i).v) / g.sin_alpha2();
    at.normals.row(i) = normal;
    at.lever[i] = g.leg(i).u.dot(normal);
  }
  return at;
}

SphericalSingularity singularity(const SphericalGeometry& g, const SphericalVelocity& at) {
  return {at.lever.cwiseAbs().minCoeff() / g.sin_alpha1(), smallest_singular_value(at.normals)};
}

SphericalJacobian jacobian(const SphericalVelocity& at) {
  if (!(at.lever.cwiseAbs().minCoeff() > kDependentNormals)) return {};
  return {SolutionStatus::kFound, at.lever.cwiseInverse().asDiagonal() * at.normals};
}

SphericalJacobian inverse_jacobian(const SphericalVelocity& at) {
  const Adjugate inverse(at.normals.row(0), at.normals.row(1), at.normals.row(2));
  if (!(std::abs(inverse.volume) > kDependentNormals)) return {};
  SphericalJacobian result;
  result.status = SolutionStatus::kFound;
  result.matrix << inverse.x, inverse.y, inverse.z;
  result.matrix *= (at.lever / inverse.volume).asDiagonal();
  return result;
}

SphericalTorque statics(const SphericalVelocity& at, const Vector3& moment_nm) {
  const SphericalJacobian turn = inverse_jacobian(at);
  if (turn.status != SolutionStatus::kFound || !moment_nm.allFinite()) return {};
  return {SolutionStatus::kFound, turn.matrix.transpose() * moment_nm};
}

}  // namespace longreach
