#pragma once
// Equation of motion of a 3-RRR spherical device in terms of the angular velocity of its platform. The
// inertia of the links is lumped into the drives. The platform with its handle is balanced about the centre
// and has the same inertia about every axis:
//
//   M α = m + Jᵀ (τ - I β),   M = I_h 1 + Jᵀ I J,   θ' = J ω,   θ'' = J α + β
//
// J is defined in spherical_statics.hpp. β follows from the second derivative of the closure equation, with n
// = (w x v)/sin(alpha2) and l = u . n:
//
//   β_i = (n'_i . ω - l'_i θ'_i) / l_i,   n' = (w' x v + w x v')/sin(alpha2),  w' = θ' u x w,  v' = ω x v

#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"
#include "schema/config_master.hpp"

namespace longreach {

/// An orientation with the quantities that occur in the equation of motion. If `closed` is false (unreachable
/// or singular), the other values are invalid.
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

  /// Returns the attitude with the platform at orientation `q`, in the base frame.
  [[nodiscard]] SphericalAttitude attitude(const Quaternion& q) const;
  /// Returns the inertia matrix M.
  [[nodiscard]] Matrix3 inertia_kg_m2(const SphericalAttitude& at) const;
  /// Returns β, rad/s², at the angular velocity `omega_rad_per_s`.
  [[nodiscard]] Vector3 rate_bias(const SphericalAttitude& at, const Vector3& omega_rad_per_s) const;
  /// Returns the moment on the platform, N m, that is equivalent to the axis torques `tau_nm`.
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
