#pragma once
// Implicit surfaces: the signed distance of a point from a solid, and the outward direction.
//   distance > 0 outside, < 0 inside (to the nearest point of the surface, exact for each shape)
// Edges and corners are sharp; a spherical tool moves around them smoothly.

#include <limits>
#include <variant>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct SurfaceSide {
  double distance_m = 0.0;
  Vector3 normal = Vector3::UnitZ();  // unit vector, outwards
};

/// The half space behind a plane.
struct HalfSpace {
  Vector3 point_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit vector, outwards
  [[nodiscard]] SurfaceSide side(const Vector3& p) const { return {normal.dot(p - point_m), normal}; }
};

struct Ball {
  Vector3 centre_m = Vector3::Zero();
  double radius_m = 1.0;
  [[nodiscard]] SurfaceSide side(const Vector3& p) const;
};

struct Block {
  Vector3 centre_m = Vector3::Zero();
  Matrix3 R = Matrix3::Identity();   // orientation of the block in W
  Vector3 half_m = Vector3::Ones();  // half the edge lengths
  [[nodiscard]] SurfaceSide side(const Vector3& p) const;
};

/// Cylinder with flat ends.
struct Rod {
  Vector3 centre_m = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();  // unit vector
  double radius_m = 1.0;
  double half_m = 1.0;  // half the length
  [[nodiscard]] SurfaceSide side(const Vector3& p) const;
};

using Shape = std::variant<HalfSpace, Ball, Block, Rod>;

inline SurfaceSide side(const Shape& shape, const Vector3& p) {
  return std::visit([&p](const auto& solid) { return solid.side(p); }, shape);
}

/// Axis-aligned box in W that contains the shape; infinite for a half space.
struct Bounds {
  Vector3 low = Vector3::Constant(-std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(std::numeric_limits<double>::infinity());
  [[nodiscard]] bool finite() const { return low.allFinite() && high.allFinite(); }
  /// Returns whether `p` is inside or at most `reach_m` away along each axis; false if `p` is not finite.
  [[nodiscard]] bool within(const Vector3& p, double reach_m) const {
    return ((p - low).array() >= -reach_m).all() && ((high - p).array() >= -reach_m).all();
  }
  [[nodiscard]] Bounds with(const Bounds& other) const {
    return {low.cwiseMin(other.low), high.cwiseMax(other.high)};
  }
};

Bounds bounds(const Shape& shape);

}  // namespace longreach
