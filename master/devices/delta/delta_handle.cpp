#include "master/devices/delta/delta_handle.hpp"

namespace longreach {

DeltaHandle::DeltaHandle(const DeviceConfig& config)
    : kinematics_(DeltaDynamics(config.delta).kinematics()),
      masses_(DeltaDynamics(config.delta).masses()),
      home_(DeltaDynamics(config.delta).home_m()),
      gravity_(config.gravity_compensation ? config.gravity_m_per_s2 : Vector3::Zero()),
      filter_s_(config.velocity_filter_s),
      p_(home_) {}

bool DeltaHandle::read(const Vector3& theta_rad, double dt_s) {
  if (!started_) {  // the device may have been switched on anywhere
    const DeltaPositions all = kinematics_.forward_all(theta_rad);
    if (all.status == SolutionStatus::kFound) p_ = all.p_m[0];
  }
  const DeltaAssembly assembly = kinematics_.geometry().working_assembly();
  DeltaPosition found = kinematics_.forward(theta_rad, assembly, p_ + stride_);
  if (found.status != SolutionStatus::kFound) found = kinematics_.forward(theta_rad, assembly, p_);
  stride_.setZero();
  if (found.status != SolutionStatus::kFound) return false;
  if (started_) stride_ = found.p_m - p_;
  if (started_ && dt_s > 0.0) v_ += dt_s / (dt_s + filter_s_) * (stride_ / dt_s - v_);
  p_ = found.p_m;
  theta_ = theta_rad;
  started_ = true;
  return true;
}

Vector3 DeltaHandle::torques(const Vector3& force_n) const {
  const DeltaVelocity at = velocity(kinematics_.geometry(), theta_, p_);
  return holding_torques(kinematics_.geometry(), masses_, gravity_, theta_, at, force_n).tau_nm;
}

}  // namespace longreach
