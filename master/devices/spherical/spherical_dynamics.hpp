#pragma once
// Equation of motion of a 3-RRR spherical device in the angular velocity of its platform, links lumped into
// the drives, the platform with its handle balanced about the centre and of equal inertia about every axis:
//
//   M α = m + Jᵀ (τ - I β),   M = I_h 1 + Jᵀ I J,   θ' = J ω,   θ'' = J α + β
//
// J of spherical_statics.hpp, (w x v)/sin(alpha2) =: n, l = u . n; β from the closure's second derivative:
//
//   β_i = (n'_i . ω - l'_i θ'_i) / l_i,   n' = (w' x v + w x v')/sin(alpha2),  w' = θ' u x w,  v' = ω x v

#include "master/config/device_config.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach {

/// An orientation with the quantities needed for the motion. If `closed` is false (impossible or singular),
/// the other values are invalid.
struct SphericalAttitude {
  bool closed = false;
  Quaternion q = Quaternion::Identity();
  Vector3 theta_rad = Vector3::Zero();
  SphericalVelocity at{};
  Matrix3 rates = Matrix3::Zero();  // J
};

class SphericalDynamics {
 public:
  /// Throws GeometryError for impossible angles.
  explicit SphericalDynamics(const SphericalConfig& config);

  [[nodiscard]] const SphericalKinematics& kinematics() const { return kinematics_; }
  [[nodiscard]] const SphericalGeometry& geometry() const { return kinematics_.geometry(); }

  [[nodiscard]] SphericalAttitude attitude(const Quaternion& q) const;
  [[nodiscard]] Matrix3 inertia_kg_m2(const SphericalAttitude& at) const;
  /// β, rad/s².
  [[nodiscard]] Vector3 rate_bias(const SphericalAttitude& at, const Vector3& omega_rad_per_s) const;
  /// Axis torques as a moment on the platform, N m.
  [[nodiscard]] static Vector3 moment(const SphericalAttitude& at, const Vector3& tau_nm) {
    return at.rates.transpose() * tau_nm;
  }
  [[nodiscard]] double axis_inertia_kg_m2() const { return axis_kg_m2_; }

 private:
  SphericalKinematics kinematics_;
  double platform_kg_m2_;
  double axis_kg_m2_;
};

}  // namespace longreach
