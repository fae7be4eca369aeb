#include "master/devices/delta/delta_dynamics.hpp"

#include <cmath>

#include "common/spatial/sin_cos.hpp"

namespace longreach {
namespace {

/// Relative to the arm; poses closer to singularity count as not closed.
constexpr double kLeastArmLever = 1e-3;

DeltaGeometry geometry_of(const DeltaConfig& c) {
  return DeltaGeometry(
      DeltaDimensions{.arm_m = c.arm_m,
                      .rod_m = c.rod_m,
                      .radius_m = c.radius_m,
                      .offset_m = c.offset_m,
                      .side_m = c.side_m,
                      .upwards = c.upwards,
                      .azimuth_rad = {c.azimuth_rad[0], c.azimuth_rad[1], c.azimuth_rad[2]}});
}

DeltaMasses masses_of(const DeltaConfig& c) {
  const DeltaMasses masses{c.platform_kg, c.arm_kg, c.arm_com_fraction, c.forearm_kg};
  require_valid(masses);
  return masses;
}

}  // namespace

DeltaDynamics::DeltaDynamics(const DeltaConfig& config)
    : kinematics_(geometry_of(config)),
      masses_(masses_of(config)),
      home_(0.0, 0.0, config.upwards ? config.home_height_m : -config.home_height_m),
      platform_kg_(config.platform_kg + 1.5 * config.forearm_kg),
      axis_kg_m2_(config.drive.inertia_kg_m2 + 0.5 * config.forearm_kg * config.arm_m * config.arm_m) {}

DeltaPose DeltaDynamics::pose(const Vector3& p_m) const {
  DeltaPose at;
  const DeltaAngles angles = kinematics_.inverse(p_m);
  if (angles.status != SolutionStatus::kFound) return at;
  at.p_m = p_m;
  at.theta_rad = angles.theta_rad;
  at.at = velocity(geometry(), angles.theta_rad, p_m);
  at.closed = at.at.lever_m.cwiseAbs().minCoeff() > kLeastArmLever * geometry().arm_m();
  if (at.closed) at.rates = at.at.lever_m.cwiseInverse().asDiagonal() * at.at.rods;
  return at;
}

Matrix3 DeltaDynamics::mass_kg(const DeltaPose& at) const {
  return platform_kg_ * Matrix3::Identity() + axis_kg_m2_ * at.rates.transpose() * at.rates;
}

Vector3 DeltaDynamics::rate_bias(const DeltaPose& at, const Vector3& v_m_per_s) const {
  const DeltaGeometry& g = geometry();
  const Vector3 rate = at.rates * v_m_per_s;
  Vector3 bias;
  for (int i = 0; i < 3; ++i) {
    const auto [s, c] = sin_cos(at.theta_rad[i]);
    const Vector3 arm = g.arm_m() * Vector3(c, 0.0, s);
    const Vector3 swing = g.arm_m() * Vector3(-s, 0.0, c);
    const Vector3 q = g.to_leg(i, at.p_m - g.elbow(i, c, s));
    const Vector3 v = g.to_leg(i, v_m_per_s) - rate[i] * swing;
    const double rho2 = q.x() * q.x() + q.z() * q.z();
    const double across = q.x() * v.z() - q.z() * v.x();  // ρ v_t
    const double curved = rho2 > 0.0 ? g.offset_m() * across * across / (rho2 * std::sqrt(rho2)) : 0.0;
    const Vector3 rod = g.to_leg(i, at.at.rods.row(i));
    bias[i] = ((v.squaredNorm() - curved) / g.rod_m() + rod.dot(arm) * rate[i] * rate[i]) / at.at.lever_m[i];
  }
  return bias;
}

Vector3 DeltaDynamics::weight(const DeltaPose& at, const Vector3& gravity_m_per_s2) const {
  const double arm_kg = masses_.arm_kg * masses_.arm_com_fraction + 0.5 * masses_.forearm_kg;
  Vector3 tau;
  for (int i = 0; i < 3; ++i) {
    const auto [s, c] = sin_cos(at.theta_rad[i]);
    tau[i] = arm_kg * geometry().arm_m() * geometry().to_leg(i, gravity_m_per_s2).dot(Vector3(-s, 0.0, c));
  }
  return platform_kg_ * gravity_m_per_s2 + force(at, tau);
}

}  // namespace longreach
