#pragma once
// Controller of a DELTA device. It converts encoder angles to position and velocity of the handle, and a
// force to motor torques. It does not model the dynamics of the device.
//
//   x from the forward kinematics in the working assembly, v its filtered backward difference,
//   τ = Jᵀ F + τ_gravity

#include "master/devices/delta/delta_dynamics.hpp"

namespace longreach {

class DeltaHandle {
 public:
  explicit DeltaHandle(const DeviceConfig& config);

  /// Updates position and velocity from the encoder angles. Call this once per sample, with `dt_s` = 0 for
  /// the first one. Returns false if no position closes the loops; the last position is then kept.
  bool read(const Vector3& theta_rad, double dt_s);

  /// Returns the motor torques, N m, that apply the force `force_n` to the hand and compensate the weight of
  /// the device.
  [[nodiscard]] Vector3 torques(const Vector3& force_n) const;

  [[nodiscard]] Vector3 position_m() const { return p_ - home_; }  // position from home
  [[nodiscard]] const Vector3& velocity_m_per_s() const { return v_; }

 private:
  DeltaKinematics kinematics_;
  DeltaMasses masses_;
  Vector3 home_;
  Vector3 gravity_;  // compensated gravity, m/s²
  double filter_s_;
  Vector3 p_;
  /// Displacement in the last sample, from which the initial guess for the next search is extrapolated.
  Vector3 stride_ = Vector3::Zero();
  Vector3 v_ = Vector3::Zero();
  Vector3 theta_ = Vector3::Zero();
  bool started_ = false;
};

}  // namespace longreach
