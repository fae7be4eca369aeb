#pragma once
// Controller of a 3-RRR spherical device. It converts encoder angles to orientation and angular velocity of
// the handle, and a moment to motor torques. It does not model the dynamics of the device.
//
//   q by tracking from the previous sample (the assembly mode is kept), ω its filtered backward difference,
//   τ = J^-T M

#include "master/devices/spherical/spherical_dynamics.hpp"

namespace longreach {

class SphericalHandle {
 public:
  explicit SphericalHandle(const DeviceConfig& config);

  /// Updates orientation and angular velocity from the encoder angles. Call this once per sample, with `dt_s`
  /// = 0 for the first one. Returns false if tracking fails; the last orientation is then kept.
  bool read(const Vector3& theta_rad, double dt_s);

  /// Sets the orientation from which tracking starts, for a device that does not start at home.
  void start_at(const Quaternion& q_MH);

  /// Returns the motor torques, N m, that apply `moment_nm` to the hand; zero at a singularity.
  [[nodiscard]] Vector3 torques(const Vector3& moment_nm) const;

  [[nodiscard]] const Quaternion& orientation() const { return pose_.q; }
  [[nodiscard]] const Vector3& angular_rad_per_s() const { return omega_; }

 private:
  SphericalKinematics kinematics_;
  double filter_s_;
  SphericalPose pose_{};
  Vector3 omega_ = Vector3::Zero();
  Vector3 theta_ = Vector3::Zero();
  bool started_ = false;
};

}  // namespace longreach
