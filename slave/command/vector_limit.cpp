#include "slave/command/vector_limit.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kBrakingShare = 0.8;
constexpr double kFull = 1.0 + 1e-9;     // of the speed, with rounding
constexpr double kAtLimit = 0.99;        // of the speed: faster counts as at the limit
constexpr double kGoalRounding = 1e-14;  // of a pose in m and rad: a goal this near is reached

// Brakes along the cap first and uses the remaining acceleration across it; both motions end inside the ball.
Vector3 brake_for(const VelocityCap& cap, const Vector3& velocity, const Vector3& wanted,
                  const VectorLimits& limits) {
  const double reach = limits.acceleration * limits.dt, down = std::max(cap.braking * limits.dt, reach);
  const double along = velocity.dot(cap.direction);
  double least = along - down;
  if (!cap.reverses) least = std::max(least, std::min(along - reach, 0.0));
  const double along_next = std::clamp(wanted.dot(cap.direction), least, along + reach);
  const double change = along_next - along;
  const Vector3 across = velocity - along * cap.direction;
  const double across_max = std::sqrt(std::max(limits.speed * limits.speed - along_next * along_next, 0.0));
  const Vector3 across_wanted = clamp_norm(wanted - wanted.dot(cap.direction) * cap.direction, across_max);
  const double left = std::sqrt(std::max(reach * reach - change * change, 0.0));
  return along_next * cap.direction + across + clamp_norm(across_wanted - across, left);
}

}  // namespace

double braking_speed(double distance, double acceleration, double dt) {
  if (!(distance > 0.0)) return 0.0;
  const double step = acceleration * dt * dt;
  const double n = std::max(1.0, std::ceil(0.5 * (std::sqrt(1.0 + 8.0 * distance / step) - 1.0)));
  return distance / (n * dt) + acceleration * dt * (n - 1.0) * 0.5;
}

VectorStep pursue(const VectorPursuit& p, const VectorLimits& limits) {
  VectorStep result;
  const Vector3 gap =
      p.error - p.goal_velocity * limits.dt;  // goal before its step minus position before ours
  const double distance = gap.stableNorm();
  const double speed = braking_speed(distance, kBrakingShare * limits.acceleration, limits.dt);
  Vector3 wanted = p.goal_velocity;
  if (distance > kGoalRounding) wanted += gap * (speed / distance);
  const bool fast = wanted.stableNorm() > limits.speed;
  wanted = clamp_norm(wanted, limits.speed);

  const VelocityCap* worst = nullptr;
  double worst_excess = 0.0;
  for (std::size_t i = 0; i < p.caps.size(); ++i) {
    const VelocityCap& cap = p.caps[i];
    if (!cap.active) continue;
    const double excess_wanted = wanted.dot(cap.direction) - cap.speed;
    if (excess_wanted > 0.0) {
      wanted -= excess_wanted * cap.direction;
      result.capped[i] = true;
    }
    const double excess = p.velocity.dot(cap.direction) - cap.speed;
    if (excess > worst_excess) {
      worst_excess = excess;
      worst = &cap;
    }
  }
  const double reach = limits.acceleration * limits.dt;
  const Vector3 change = wanted - p.velocity;
  result.velocity =
      worst ? brake_for(*worst, p.velocity, wanted, limits) : p.velocity + clamp_norm(change, reach);
  // Backing out while the rest of the motion has yet to end. From within the ball its nearest place is no
  // further.
  if (p.velocity.stableNorm() <= kFull * limits.speed)
    result.velocity = clamp_norm(result.velocity, limits.speed);
  result.fast = fast && result.velocity.stableNorm() >= kAtLimit * limits.speed;
  result.hasty = !result.fast && (fast || change.stableNorm() > reach);
  return result;
}

}  // namespace longreach
