#include "master/devices/spherical/spherical_handle.hpp"

namespace longreach {

SphericalHandle::SphericalHandle(const DeviceConfig& config)
    : kinematics_(SphericalDynamics(config.spherical).kinematics()), filter_s_(config.velocity_filter_s) {}

void SphericalHandle::start_at(const Quaternion& q_MH) {
  pose_ = {SolutionStatus::kFound, q_MH, 0, 0};
  started_ = false;
}

bool SphericalHandle::read(const Vector3& theta_rad, double dt_s) {
  const SphericalPose found = kinematics_.forward(theta_rad, pose_);
  if (found.status != SolutionStatus::kFound) return false;
  if (started_ && dt_s > 0.0) {
    const Vector3 turned = log_rotation(found.q * pose_.q.conjugate());
    omega_ += dt_s / (dt_s + filter_s_) * (turned / dt_s - omega_);
  }
  pose_ = found;
  theta_ = theta_rad;
  started_ = true;
  return true;
}

Vector3 SphericalHandle::torques(const Vector3& moment_nm) const {
  return statics(velocity(kinematics_.geometry(), theta_, pose_.q), moment_nm).nm;
}

}  // namespace longreach
