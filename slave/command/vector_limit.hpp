#pragma once
// Velocity that moves a point to its goal as fast as speed and acceleration permit, without overshoot.
//   u(r) = r/(N dt) + a dt (N - 1)/2,  N = ⌈(√(1 + 8 r/(a dt²)) - 1)/2⌉
// is the maximum speed from which N equal steps of braking at a end exactly at distance r (discrete form of
// √(2 a r)). It is applied to the motion relative to the goal, v = v_goal + u(|r|) r/|r|, so that a goal
// within the limits is followed without lag once reached. Caps bound the component of the velocity in given
// directions. Braking for distance uses 0.8 of the acceleration; the remainder turns the path.

#include <array>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Maximum speed (>= 0) from which steps of braking at `acceleration` end at `distance` (>= 0). Any unit of
/// length.
double braking_speed(double distance, double acceleration, double dt);

/// v · direction <= speed, direction a unit vector, speed >= 0.
struct VelocityCap {
  Vector3 direction = Vector3::Zero();
  double speed = 0.0;
  bool active = false;
};

struct VectorLimits {
  double speed = 0.0;         // per s
  double acceleration = 0.0;  // per s²
  double dt = 0.0;            // > 0, s
};

struct VectorPursuit {
  Vector3 velocity = Vector3::Zero();       // of the last step
  Vector3 goal_velocity = Vector3::Zero();  // of the goal in this step
  Vector3 error = Vector3::Zero();          // goal now minus position before the step
  std::array<VelocityCap, 3> caps{};
};

struct VectorStep {
  Vector3 velocity = Vector3::Zero();  // for this step; changed by at most acceleration * dt
  bool fast = false;                   // at the speed limit, below the requested speed
  bool hasty = false;                  // limited by the acceleration
  std::array<bool, 3> capped{};        // caps that were active
};

VectorStep pursue(const VectorPursuit& pursuit, const VectorLimits& limits);

}  // namespace longreach
