#pragma once
// Simulation of a 3-RRR spherical device: mechanism, drives, the mechanical limit of its workspace, and the
// wrist of the hand on the handle.
//
//   M α = m_hand + m_edge + Jᵀ (τ_motor + τ_friction - b J ω - I β)
//
// It is integrated as in simulated_delta.hpp, with the exponential map for the orientation.

#include "master/devices/drive/drives.hpp"
#include "master/devices/spherical/spherical_dynamics.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {

class SimulatedSpherical {
 public:
  /// Throws GeometryError for an impossible device, or if the workspace is not completely reachable.
  explicit SimulatedSpherical(const DeviceConfig& config);

  /// Places the handle at an orientation, at rest. Returns false and changes nothing if it is not reachable.
  bool place(const Quaternion& q_MH);

  /// Advances by `dt_s` > 0. `hand_rad` is the target of the wrist, a rotation vector from home.
  void step(double dt_s, const WristModel& wrist, const Vector3& hand_rad);

  /// Sets the commanded motor torques.
  void command(const Vector3& tau_nm) { drives_.command(tau_nm); }
  [[nodiscard]] Vector3 encoder_rad() const { return drives_.encoder(attitude_.theta_rad); }

  [[nodiscard]] const SphericalDynamics& dynamics() const { return dynamics_; }
  [[nodiscard]] const Quaternion& orientation() const { return attitude_.q; }  // true orientation
  [[nodiscard]] const Vector3& angular_rad_per_s() const { return omega_; }
  [[nodiscard]] double energy_j() const {  // kinetic energy, without the hand
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
