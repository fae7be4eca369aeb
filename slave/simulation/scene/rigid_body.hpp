#pragma once
// Motion of a free rigid body over one step under the mean wrench w: the midpoint rule for the translation,
// and the energy-momentum rule of Simo and Wong (1991) for the rotation,
//   Δp = dt (v + dt F/2m),   Δv = dt F/m
//   R' = R cay(dt Ω̄),        L' = L + dt M,    Ω̄ = (Ω + Ω')/2,   L = R I Ω
// The rule conserves momentum, and the kinetic energy changes by exactly w·move, where move = [θ; Δp] with
// the Cayley vector θ = dt R Ω̄. A point x of the body moves by Δx = Δp + θ × (x̄ - p̄); bars denote means
// over the step. A force at this point does the work F·Δx, which can be balanced against energy that is
// stored elsewhere.

#include "common/spatial/spatial.hpp"

namespace longreach {

struct RigidMass {
  double mass_kg = 1.0;  // > 0
  Vector3 inertia_kg_m2 =
      Vector3::Ones();  // moments of inertia about the centre of mass, along the principal axes; > 0
  Vector3 gravity_m_per_s2 = Vector3::Zero();
};

struct RigidState {
  Pose X{};                                    // frame at the centre of mass along the principal axes
  Vector3 v_m_per_s = Vector3::Zero();         // velocity of the centre of mass
  Vector3 spin_kg_m2_per_s = Vector3::Zero();  // angular momentum about the centre of mass, in W
};

struct RigidMove {
  Vector3 turn = Vector3::Zero();  // Cayley vector in W: 2 tan(angle/2) along the axis
  Vector3 way_m = Vector3::Zero();
};

struct RigidStep {
  RigidState to{};
  RigidMove move{};
};

/// Returns the state after a step. `wrench`: [moment about the centre of mass; force], mean over `dt` > 0,
/// without gravity.
RigidStep step_rigid(const RigidMass& mass, const RigidState& from, const Vector6& wrench, double dt);

/// Returns the move between two poses; the rotation between them must be less than π.
RigidMove move_between(const Pose& from, const Pose& to);

/// Returns the approximate derivative of [turn; way] with respect to the wrench.
Eigen::Matrix<double, 6, 6> rigid_compliance(const RigidMass& mass, const Pose& X, double dt);

/// Returns the angular velocity in W.
Vector3 angular_rad_per_s(const RigidMass& mass, const RigidState& state);
/// Returns kinetic plus gravitational energy; the latter is zero at the origin.
double energy_j(const RigidMass& mass, const RigidState& state);

}  // namespace longreach
