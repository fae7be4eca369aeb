#include "slave/simulation/scene/shape.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {

SurfaceSide Ball::side(const Vector3& p) const {
  const Vector3 out = p - centre_m;
  const double r = out.norm();
  return {r - radius_m, r > 0.0 ? Vector3(out / r) : Vector3::UnitZ()};
}

SurfaceSide Block::side(const Vector3& p) const {
  const Vector3 q = R.transpose() * (p - centre_m);
  const Vector3 beyond = q.cwiseAbs() - half_m;
  if ((beyond.array() <= 0.0).all()) {
    Eigen::Index face = 0;
    const double depth = beyond.maxCoeff(&face);
    return {depth, R.col(face) * (q[face] < 0.0 ? -1.0 : 1.0)};
  }
  Vector3 out = beyond.cwiseMax(0.0);
  const double distance = out.norm();
  for (int i = 0; i < 3; ++i) out[i] = std::copysign(out[i], q[i]);
  return {distance, R * out / distance};
}

SurfaceSide Rod::side(const Vector3& p) const {
  const Vector3 q = p - centre_m;
  const double along = q.dot(axis);
  const Vector3 across = q - along * axis;
  const double r = across.norm();
  const double end = std::abs(along) - half_m, round = r - radius_m;
  const Vector3 end_normal = along < 0.0 ? Vector3(-axis) : axis;
  const Vector3 round_normal = r > 0.0 ? Vector3(across / r) : axis.unitOrthogonal();
  if (end <= 0.0 && round <= 0.0)
    return end > round ? SurfaceSide{end, end_normal} : SurfaceSide{round, round_normal};
  if (end <= 0.0) return {round, round_normal};
  if (round <= 0.0) return {end, end_normal};
  const double distance = std::hypot(end, round);
  return {distance, (end * end_normal + round * round_normal) / distance};
}

namespace {

Bounds around(const Vector3& centre, const Vector3& half) { return {centre - half, centre + half}; }

Bounds bounds_of(const HalfSpace&) { return {}; }
Bounds bounds_of(const Ball& b) { return around(b.centre_m, Vector3::Constant(b.radius_m)); }
Bounds bounds_of(const Block& b) { return around(b.centre_m, b.R.cwiseAbs() * b.half_m); }
Bounds bounds_of(const Rod& r) {
  const Vector3 disc = r.radius_m * (Vector3::Ones() - r.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return around(r.centre_m, r.half_m * r.axis.cwiseAbs() + disc);
}

}  // namespace

Bounds bounds(const Shape& shape) {
  return std::visit([](const auto& solid) { return bounds_of(solid); }, shape);
}

}  // namespace longreach
