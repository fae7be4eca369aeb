#pragma once
// Controller of a 3-RRR spherical device: encoder angles to orientation and angular velocity of the handle,
// moment to motor torques. It does not model the dynamics of the device.
//
//   q by tracking from the previous sample (the assembly mode is kept), ω its filtered backward difference,
//   τ = J^-T M

#include "master/devices/spherical/spherical_dynamics.hpp"

namespace longreach {

class SphericalHandle {
 public:
  explicit SphericalHandle(const DeviceConfig& config);

  /// Call it once per sample of `dt_s`; 0 for the first. Returns false if the orientation is lost; the last
  /// one is then kept.
  bool read(const Vector3& theta_rad, double dt_s);

  /// Sets the start of the tracking, for a device that does not start at home.
  void start_at(const Quaternion& q_MH);

  /// Returns the motor torques that act on the hand with `moment_nm`, N m. Zero at a singularity.
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
