#pragma once
// A handle that moves randomly in its workspace, and random configurations of the mapping, for property tests
// over seeds.

#include "common/core/random.hpp"
#include "master/mapping/mapping.hpp"

namespace longreach {

constexpr double kTick_s = 0.001;

inline Vector3 normal_vector(Random& random, double sd) {
  return sd * Vector3(random.normal(), random.normal(), random.normal());
}

inline double twentieths(Random& random) { return 0.05 * std::floor(random.uniform(1.0, 21.0)); }

/// Moves the handle for one tick at its current velocity, then changes the velocity randomly, with a drift
/// towards the home position that grows with the distance.
inline void wander(HandleState& h, Random& random, double speed_m_per_s, double speed_rad_per_s) {
  h.p_MH += kTick_s * h.velocity_m_per_s;
  h.q_MH = (exp_rotation(kTick_s * h.angular_rad_per_s) * h.q_MH).normalized();
  const auto steer = [&](const Vector3& v, const Vector3& x, double radius, double speed) {
    return Vector3(0.98 * v + normal_vector(random, 0.2 * speed) - 0.02 * speed / radius * x);
  };
  h.velocity_m_per_s = steer(h.velocity_m_per_s, h.p_MH, 0.03, speed_m_per_s);
  h.angular_rad_per_s = steer(h.angular_rad_per_s, log_rotation(h.q_MH), 0.3, speed_rad_per_s);
}

inline MappingConfig any_mapping(Random& random) {
  MappingConfig config;
  config.rate_law = random.chance(0.5) ? RateLaw::kContinuous : RateLaw::kLiteral;
  config.base_rotation_rad = normal_vector(random, 1.0);
  config.speed_max_m_per_s = std::exp(random.uniform(-4.0, 4.0));
  config.speed_max_rad_per_s = std::exp(random.uniform(-4.0, 4.0));
  config.rate_centre = random.chance(0.5) ? RateCentre::kHandleOrigin : RateCentre::kWhereModeBegan;
  return config;
}

inline double angle_between(const Quaternion& a, const Quaternion& b) {
  return log_rotation(a * b.conjugate()).norm();
}

}  // namespace longreach
