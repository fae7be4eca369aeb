#pragma once
// Computes the velocity that moves a point to its goal as fast as its speed and acceleration limits permit,
// without overshoot. The maximum speed from which N equal steps of braking with deceleration a end exactly at
// the distance r is
//   u(r) = r/(N dt) + a dt (N - 1)/2,  N = ⌈(√(1 + 8 r/(a dt²)) - 1)/2⌉
// This is the discrete form of √(2 a r). It is applied to the motion relative to the goal, v = v_goal +
// u(|r|) r/|r|, so that a goal that moves within the limits is followed without lag once it is reached. Caps
// limit the component of the velocity in given directions. Braking before the goal uses only 0.8 of the
// acceleration limit; the remainder is available for curved paths.

#include <array>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Returns the maximum speed (>= 0) from which braking at `acceleration`, in steps of `dt` s, ends at
/// `distance` (>= 0). The unit of length is arbitrary.
double braking_speed(double distance, double acceleration, double dt);

/// Limits v · direction to `speed`; `direction` is a unit vector. A negative speed requires motion in the
/// opposite direction.
struct VelocityCap {
  Vector3 direction = Vector3::Zero();
  double speed = 0.0;
  bool active = false;
  /// Maximum deceleration along `direction`, if greater than that of the other motion, per s².
  double braking = 0.0;
  /// With `braking`, the motion may also be reversed.
  bool reverses = false;
};

struct VectorLimits {
  double speed = 0.0;         // per s
  double acceleration = 0.0;  // per s²
  double dt = 0.0;            // > 0, s
};

struct VectorPursuit {
  Vector3 velocity = Vector3::Zero();       // velocity in the previous step
  Vector3 goal_velocity = Vector3::Zero();  // velocity of the goal in this step
  Vector3 error = Vector3::Zero();          // current goal minus position before the step
  std::array<VelocityCap, 3> caps{};
};

struct VectorStep {
  Vector3 velocity = Vector3::Zero();  // velocity in this step; it changes by at most acceleration * dt
  bool fast = false;                   // limited by the speed limit
  bool hasty = false;                  // limited by the acceleration limit
  std::array<bool, 3> capped{};        // caps that limited the velocity
};

/// Returns the velocity in this step and the limits that affected it.
VectorStep pursue(const VectorPursuit& pursuit, const VectorLimits& limits);

}  // namespace longreach
