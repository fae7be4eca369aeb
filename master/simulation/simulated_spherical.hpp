#pragma once
// Simulation of a 3-RRR spherical device: mechanism, drives, the mechanical limit of its workspace, and the
// wrist of the hand on it.
//
//   M α = m_hand + m_edge + Jᵀ (τ_motor + τ_friction - b J ω - I β)
//
// Integrated like simulated_delta.hpp, the orientation by the exponential map.

#include "master/devices/drive/drives.hpp"
#include "master/devices/spherical/spherical_dynamics.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {

class SimulatedSpherical {
 public:
  /// Throws GeometryError, also if the workspace is not completely reachable.
  explicit SimulatedSpherical(const DeviceConfig& config);

  /// Puts the handle at rest. Returns false and changes nothing if that is impossible.
  bool place(const Quaternion& q_MH);

  /// Advances by `dt_s` > 0 with the target `hand_rad` of the wrist (rotation vector from home).
  void step(double dt_s, const WristModel& wrist, const Vector3& hand_rad);

  void command(const Vector3& tau_nm) { drives_.command(tau_nm); }
  [[nodiscard]] Vector3 encoder_rad() const { return drives_.encoder(attitude_.theta_rad); }

  [[nodiscard]] const SphericalDynamics& dynamics() const { return dynamics_; }
  [[nodiscard]] const Quaternion& orientation() const { return attitude_.q; }  // true
  [[nodiscard]] const Vector3& angular_rad_per_s() const { return omega_; }
  [[nodiscard]] double energy_j() const {  // kinetic, without hand
    return 0.5 * omega_.dot(dynamics_.inertia_kg_m2(attitude_) * omega_);
  }

 private:
  void move(double dt_s, const WristModel& wrist, const Quaternion& wanted);
  [[nodiscard]] Vector3 edge_moment() const;
  void require_workspace() const;

  SphericalDynamics dynamics_;
  Drives drives_;
  double workspace_rad_;
  SphericalAttitude attitude_{};
  Vector3 omega_ = Vector3::Zero();
  Vector3 friction_nm_ = Vector3::Zero();
};

}  // namespace longreach
