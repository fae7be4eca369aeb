#pragma once
// Interaction of two bodies A and B over one step, such that no step creates energy. The forces between them
// are equal and opposite, act at one point, and do the work that is stored or dissipated (rigid_body.hpp
// defines the motion of a point in a step). With the motion u of B relative to A at that point, a damper
// exerts the force -D u/dt. A potential U (of depth or stretch) exerts a mean force F̄, corrected along u
// such that F·u = -ΔU (Gonzalez 1996):
//   F = F̄ + (-ΔU - F̄·u) u/|u|²

#include "schema/config_scene.hpp"
#include "slave/simulation/scene/hunt_crossley.hpp"
#include "slave/simulation/scene/rigid_body.hpp"

namespace longreach {

/// Motion of a body over a step.
struct Mover {
  Pose from{}, to{};
  RigidMove move{};
  [[nodiscard]] Vector3 middle() const { return 0.5 * (from.p + to.p); }
  /// Displacement of the point of the body that is at x in the middle of the step.
  [[nodiscard]] Vector3 way_of(const Vector3& x) const { return move.way_m + move.turn.cross(x - middle()); }
};

/// Wrench on B; the opposite wrench acts on A.
struct Interaction {
  Vector3 point_m = Vector3::Zero();
  Vector3 force_n = Vector3::Zero();
  Vector3 moment_nm = Vector3::Zero();
  Matrix3 by_way = Matrix3::Zero();   // approximately -∂force/∂u, N/m
  Matrix3 by_turn = Matrix3::Zero();  // approximately -∂moment/∂turn, N m/rad
};

/// A pair of surfaces that touch or are near each other.
struct SurfacePair {
  double depth_m = 0.0;  // negative: the surfaces are apart
  Vector3 point_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit vector, from A to B
};

/// Returns the interaction of one contact from its geometry before and after the step.
Interaction touch(const HuntCrossley& law, const SurfacePair& before, const SurfacePair& after,
                  const Mover& a, const Mover& b, double dt);

/// Rest configuration of a bond: the relative pose of A and B at which the bond exerts no force.
struct BondRest {
  /// The point at which the bond acts, in the frames of A and of B.
  Vector3 on_a_m = Vector3::Zero(), on_b_m = Vector3::Zero();
  Quaternion q_AB = Quaternion::Identity();
};
/// Returns the rest configuration for these poses of A and B; the bond acts at `point_m`.
BondRest rest(const Pose& X_A, const Pose& X_B, const Vector3& point_m);

/// Returns the interaction of a bond over a step.
Interaction hold(const BondConfig& bond, const BondRest& rest, const Mover& a, const Mover& b, double dt);

/// Returns the energy stored in a bond.
double energy_j(const BondConfig& bond, const BondRest& rest, const Pose& X_A, const Pose& X_B);

}  // namespace longreach
