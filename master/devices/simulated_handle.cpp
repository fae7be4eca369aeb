#include "master/devices/simulated_handle.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kStep_s = 50e-6;
constexpr double kLongestStep_s = 0.05;  // a stalled program does not leap
constexpr double kVelocityFilter_s = 0.002;
constexpr double kEdge_n_per_m = 2000.0;
constexpr double kEdge_n_s_per_m = 20.0;
// Rotational hand: a wrist that lightly holds the handle, of the handle's own order of magnitude.
constexpr double kWrist_nm_per_rad = 0.6;
constexpr double kWrist_nm_s_per_rad = 0.02;

double quantised(double value, double step) { return step > 0.0 ? std::round(value / step) * step : value; }

}  // namespace

HandModel hand_model(Grip grip) {
  switch (grip) {
    case Grip::kLight:
      return {0.55, 6.5, 135.0};
    case Grip::kFirm:
      return {1.7, 16.0, 400.0};
    case Grip::kReleased:
      break;
  }
  return {};
}

HandleState SimulatedHandle::read(Time now) {
  if (!started_) {
    started_ = true;
    now_ = now;
    measured_.p_MH = x_;
    return measured_;
  }
  const double dt_s = std::clamp(to_seconds(now - now_), 0.0, kLongestStep_s);
  now_ = now;
  if (dt_s <= 0.0) return measured_;
  hand_m_ = target_.position_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kStep_s)));
  for (int i = 0; i < steps; ++i) {
    hand_m_ += target_.velocity_m_per_s * (dt_s / steps);
    move(dt_s / steps);
    turn(dt_s / steps);
  }
  measure(dt_s);
  return measured_;
}

void SimulatedHandle::move(double dt_s) {
  const HandModel hand = hand_model(target_.grip);
  Vector3 f = motor_.force - config_.damping_n_s_per_m * v_ + hand.stiffness_n_per_m * (hand_m_ - x_) +
              hand.damping_n_s_per_m * (target_.velocity_m_per_s - v_);
  const double r = x_.norm();
  if (r > config_.workspace_m) {
    const Vector3 outward = x_ / r;
    const double push = kEdge_n_per_m * (r - config_.workspace_m) + kEdge_n_s_per_m * outward.dot(v_);
    f -= std::max(0.0, push) * outward;
  }
  v_ += dt_s / (config_.mass_kg + hand.mass_kg) * f;
  x_ += dt_s * v_;
}

void SimulatedHandle::turn(double dt_s) {
  const bool held = target_.grip != Grip::kReleased;
  Vector3 moment = motor_.moment - config_.rotational_damping_nm_s_per_rad * omega_;
  if (held) {
    const Vector3 left = log_rotation(exp_rotation(target_.rotation_rad) * q_.conjugate());
    moment += kWrist_nm_per_rad * left - kWrist_nm_s_per_rad * omega_;
  }
  omega_ += dt_s / config_.inertia_kg_m2 * moment;
  q_ = (exp_rotation(dt_s * omega_) * q_).normalized();
  const Vector3 turned = log_rotation(q_);
  if (turned.norm() > config_.workspace_rad) {
    q_ = exp_rotation(clamp_norm(turned, config_.workspace_rad));
    omega_ -= turned.normalized() * std::max(0.0, turned.normalized().dot(omega_));
  }
}

void SimulatedHandle::measure(double dt_s) {
  const double share = dt_s / (dt_s + kVelocityFilter_s);
  const Vector3 x_before = measured_.p_MH;
  const Quaternion q_before = measured_.q_MH;
  for (int i = 0; i < 3; ++i) measured_.p_MH(i) = quantised(x_(i), config_.resolution_m);
  Vector3 turned = log_rotation(q_);
  for (int i = 0; i < 3; ++i) turned(i) = quantised(turned(i), config_.resolution_rad);
  measured_.q_MH = exp_rotation(turned);
  measured_.velocity_m_per_s += share * ((measured_.p_MH - x_before) / dt_s - measured_.velocity_m_per_s);
  measured_.angular_rad_per_s +=
      share * (log_rotation(measured_.q_MH * q_before.conjugate()) / dt_s - measured_.angular_rad_per_s);
}

void SimulatedHandle::write(const Wrench& F_H_M) {
  motor_.force = clamp_norm(F_H_M.force, config_.force_max_n);
  motor_.moment = clamp_norm(F_H_M.moment, config_.moment_max_nm);
}

}  // namespace longreach
