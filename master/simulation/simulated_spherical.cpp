#include "master/simulation/simulated_spherical.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace longreach {
namespace {

constexpr double kSphericalStep_s = 1e-3;
constexpr double kEdge_nm_per_rad = 15.0;
constexpr double kEdge_nm_s_per_rad = 0.03;
constexpr double kSphericalBeyond = 1.05;  // radius that must be reachable, relative to the workspace
constexpr double kLeastMeasure = 0.1;      // minimum distance from both singularities there

}  // namespace

SimulatedSpherical::SimulatedSpherical(const DeviceConfig& config)
    : dynamics_(config.spherical),
      drives_(config.spherical.drive, config.delay_samples),
      workspace_rad_(config.spherical.workspace_rad) {
  require_workspace();
  place(Quaternion::Identity());
}

void SimulatedSpherical::require_workspace() const {
  const auto require = [&](const Quaternion& q, const std::string& trouble) {
    const SphericalAttitude at = dynamics_.attitude(q);
    if (at.closed) {
      const SphericalSingularity far = singularity(dynamics_.geometry(), at.at);
      if (far.legs > kLeastMeasure && far.platform > kLeastMeasure) return;
    }
    throw GeometryError(trouble);
  };
  require(Quaternion::Identity(),
          "beta1, beta2: the handle cannot reach its upright orientation, or is "
          "singular in it");
  for (int i = 0; i < 27; ++i) {
    const Vector3 axis(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (axis.isZero(0.0)) continue;
    require(exp_rotation(kSphericalBeyond * workspace_rad_ * axis.normalized()),
            "workspace_rad: this angle exceeds the rotation range of the device about at least one axis");
  }
}

bool SimulatedSpherical::place(const Quaternion& q_MH) {
  const SphericalAttitude at = dynamics_.attitude(q_MH);
  if (!at.closed) return false;
  attitude_ = at;
  omega_.setZero();
  friction_nm_.setZero();
  drives_.place(attitude_.theta_rad);
  return true;
}

Vector3 SimulatedSpherical::edge_moment() const {
  const Vector3 turned = log_rotation(attitude_.q);
  const double angle = turned.norm();
  if (angle <= workspace_rad_) return Vector3::Zero();
  const Vector3 outward = turned / angle;
  const double push = kEdge_nm_per_rad * (angle - workspace_rad_) + kEdge_nm_s_per_rad * outward.dot(omega_);
  return -std::max(0.0, push) * outward;
}

void SimulatedSpherical::step(double dt_s, const WristModel& wrist, const Vector3& hand_rad) {
  const Quaternion wanted = exp_rotation(hand_rad);
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kSphericalStep_s - 1e-9)));
  for (int i = 0; i < steps; ++i) move(dt_s / steps, wrist, wanted);
}

void SimulatedSpherical::move(double dt_s, const WristModel& wrist, const Quaternion& wanted) {
  const double half_s = 0.5 * dt_s;
  const Vector3 motor_nm = drives_.run(dt_s);
  const double b = drives_.viscous_nm_s_per_rad(), axis = dynamics_.axis_inertia_kg_m2();
  const auto push = [&]() -> Vector3 {
    Vector3 m = edge_moment() + SphericalDynamics::moment(attitude_, motor_nm + friction_nm_);
    if (wrist.stiffness_nm_per_rad > 0.0)
      m += wrist.stiffness_nm_per_rad * log_rotation(wanted * attitude_.q.conjugate());
    return m;
  };
  const auto damping = [&]() -> Matrix3 {
    return b * attitude_.rates.transpose() * attitude_.rates +
           wrist.damping_nm_s_per_rad * Matrix3::Identity();
  };
  const auto bias = [&](const Vector3& omega) -> Vector3 {
    return axis * SphericalDynamics::moment(attitude_, dynamics_.rate_bias(attitude_, omega));
  };
  const Vector3 a =
      dynamics_.inertia_kg_m2(attitude_).inverse() * (push() - damping() * omega_ - bias(omega_));
  const Vector3 omega_half = omega_ + half_s * a;
  const SphericalAttitude next =
      dynamics_.attitude((exp_rotation(dt_s * omega_half) * attitude_.q).normalized());
  if (!next.closed) {  // the device cannot reach that pose and stops
    omega_.setZero();
    return;
  }
  attitude_ = next;
  friction_nm_ = drives_.friction(attitude_.theta_rad);
  const Matrix3 M = dynamics_.inertia_kg_m2(attitude_);
  omega_ = (M + half_s * damping()).inverse() *
           (M * omega_half + half_s * (push() - bias(2.0 * omega_half - omega_)));
}

}  // namespace longreach
