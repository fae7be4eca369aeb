#include "master/devices/spherical/spherical_dynamics.hpp"

#include <cmath>

#include "common/spatial/sin_cos.hpp"

namespace longreach {
namespace {

constexpr double kLeastLever = 1e-3;  // poses closer to singularity count as not closed

}  // namespace

SphericalDynamics::SphericalDynamics(const SphericalConfig& c)
    : kinematics_(SphericalGeometry(SphericalAngles{c.alpha1_rad, c.alpha2_rad, c.beta1_rad, c.beta2_rad})),
      platform_kg_m2_(c.inertia_kg_m2),
      axis_kg_m2_(c.drive.inertia_kg_m2) {}

SphericalAttitude SphericalDynamics::attitude(const Quaternion& q) const {
  SphericalAttitude at;
  const SphericalMotors motors = kinematics_.inverse(q);
  if (motors.status != SolutionStatus::kFound) return at;
  at.q = q;
  at.theta_rad = motors.theta_rad;
  at.at = velocity(geometry(), motors.theta_rad, q);
  at.closed = at.at.lever.cwiseAbs().minCoeff() > kLeastLever;
  if (at.closed) at.rates = at.at.lever.cwiseInverse().asDiagonal() * at.at.normals;
  return at;
}

Matrix3 SphericalDynamics::inertia_kg_m2(const SphericalAttitude& at) const {
  return platform_kg_m2_ * Matrix3::Identity() + axis_kg_m2_ * at.rates.transpose() * at.rates;
}

Vector3 SphericalDynamics::rate_bias(const SphericalAttitude& at, const Vector3& omega_rad_per_s) const {
  const SphericalGeometry& g = geometry();
  const Matrix3 R = at.q.toRotationMatrix();
  const Vector3 rate = at.rates * omega_rad_per_s;
  Vector3 bias;
  for (int i = 0; i < 3; ++i) {
    const auto [s, c] = sin_cos(at.theta_rad[i]);
    const Vector3& u = g.leg(i).u;
    const Vector3 w = g.middle_axis(i, c, s), v = R * g.leg(i).v;
    const Vector3 w_rate = rate[i] * u.cross(w), v_rate = omega_rad_per_s.cross(v);
    const Vector3 n_rate = (w_rate.cross(v) + w.cross(v_rate)) / g.sin_alpha2();
    bias[i] = (n_rate.dot(omega_rad_per_s) - u.dot(n_rate) * rate[i]) / at.at.lever[i];
  }
  return bias;
}

}  // namespace longreach
