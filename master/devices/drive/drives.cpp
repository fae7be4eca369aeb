#include "master/devices/drive/drives.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace longreach {
namespace {

constexpr double kPresliding_rad = 5e-4;  // elastic range of a bearing before it slips, assumed
// The elastic range is longer if the friction is so strong that its stiffness would be too high for steps of
// a millisecond.
constexpr double kSoftest_s2 = 1e-5;

}  // namespace

Drives::Drives(const DriveConfig& config, std::uint32_t delay_samples)
    : config_(config),
      delay_samples_(std::min(delay_samples, kMostDelay)),
      lag_s_(config.bandwidth_hz > 0.0 ? 0.5 * std::numbers::inv_pi / config.bandwidth_hz : 0.0),
      presliding_rad_(kPresliding_rad) {
  if (config.inertia_kg_m2 > 0.0)
    presliding_rad_ = std::max(presliding_rad_, kSoftest_s2 * config.coulomb_nm / config.inertia_kg_m2);
  waiting_.fill(Vector3::Zero());
  stretch_.fill(Vector3::Zero());
}

void Drives::command(const Vector3& tau_nm) {
  std::copy_backward(waiting_.begin(), waiting_.end() - 1, waiting_.end());
  const double most = config_.torque_max_nm;
  waiting_[0] = tau_nm.allFinite() ? Vector3(tau_nm.cwiseMax(-most).cwiseMin(most)) : Vector3::Zero();
}

Vector3 Drives::run(double dt_s) {
  const Vector3& wanted = waiting_[delay_samples_];
  if (lag_s_ <= 0.0) return tau_ = wanted;
  const double gone = -std::expm1(-dt_s / lag_s_);  // fraction of the gap that is closed
  const Vector3 gap = tau_ - wanted;
  tau_ = wanted + (1.0 - gone) * gap;
  return wanted + gap * (dt_s > 0.0 ? gone * lag_s_ / dt_s : 1.0);
}

void Drives::place(const Vector3& theta_rad) {
  theta_ = theta_rad;
  stretch_.fill(Vector3::Zero());
}

Vector3 Drives::friction(const Vector3& theta_rad) {
  Vector3 share = Vector3::Zero();  // fraction of the Coulomb torque
  double range = presliding_rad_;
  for (Vector3& z : stretch_) {
    z = (z + theta_rad - theta_).cwiseMax(-range).cwiseMin(range);
    share += z / (kElements * range);
    range *= 0.5;
  }
  theta_ = theta_rad;
  return -config_.coulomb_nm * share;
}

Vector3 Drives::encoder(const Vector3& theta_rad) const {
  const double step = config_.resolution_rad;
  return step > 0.0 ? Vector3((theta_rad / step).array().round() * step) : theta_rad;
}

}  // namespace longreach
