#include "master/mapping/mapping.hpp"

#include <algorithm>

namespace longreach {

Vector3 rate_law(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law) {
  const double r = deflection.stableNorm();
  if (!(r > dead_zone)) return Vector3::Zero();
  const double capped = std::min(r, std::max(radius_max, dead_zone));
  const double effective = law == RateLaw::kContinuous ? capped - dead_zone : capped;
  return deflection * (effective / r);
}

void Mapping::reset(const HandleState& handle) {
  goal_ = Goal{};
  frozen_ = true;
  take_references(handle);
}

void Mapping::take_references(const HandleState& handle) {
  x_ref_ = handle.p_MH;
  q_ref_ = handle.q_MH;
  g_ref_ = goal_.position_m;
  q_gref_ = goal_.rotation;
}

const Goal& Mapping::step(const MappingInput& input, double dt_s) {
  goal_.translation_moved = goal_.rotation_moved = false;
  if (!input.handle.p_MH.allFinite() || !input.handle.q_MH.coeffs().allFinite()) return goal_;
  if (input.mode != mode_ || input.scale != scale_ || input.frozen != frozen_ || input.frozen) {
    mode_ = input.mode;
    scale_ = input.scale;
    frozen_ = input.frozen;
    take_references(input.handle);
  }
  if (frozen_) return goal_;

  const Vector3 before = goal_.position_m;
  const Quaternion rotation_before = goal_.rotation;
  if (mode_ == MotionMode::kRate) {
    step_rate(input.handle, dt_s);
  } else {
    step_position(input.handle, dt_s);
  }
  goal_.translation_moved = goal_.position_m != before;
  goal_.rotation_moved = goal_.rotation.coeffs() != rotation_before.coeffs();
  return goal_;
}

void Mapping::step_rate(const HandleState& handle, double dt_s) {
  // The centre goes home with the hand, so that letting go commands nothing.
  x_ref_ = clamp_norm(x_ref_, handle.p_MH.stableNorm());
  const Vector3 speed = config_.kv_per_s * rate_law(handle.p_MH - x_ref_, config_.dead_zone_m,
                                                    config_.radius_max_m, config_.rate_law);
  goal_.position_m += dt_s * clamp_norm(speed, config_.speed_max_m_per_s);
  const Vector3 turn = log_rotation(handle.q_MH * q_ref_.conjugate());
  const Vector3 rate = config_.kv_rotation_per_s *
                       rate_law(turn, config_.dead_zone_rad, config_.radius_max_rad, config_.rate_law);
  if (rate.isZero(0.0)) return;
  goal_.rotation = exp_rotation(dt_s * clamp_norm(rate, config_.speed_max_rad_per_s)) * goal_.rotation;
}

void Mapping::step_position(const HandleState& handle, double dt_s) {
  const Vector3 wanted = g_ref_ + scale_ * (handle.p_MH - x_ref_);
  goal_.position_m += clamp_norm(wanted - goal_.position_m, config_.speed_max_m_per_s * dt_s);
  const Vector3 turn = scale_ * log_rotation(handle.q_MH * q_ref_.conjugate());
  const Quaternion wanted_q = exp_rotation(turn) * q_gref_;
  const Vector3 left = log_rotation(wanted_q * goal_.rotation.conjugate());
  if (left.isZero(0.0)) return;
  goal_.rotation = exp_rotation(clamp_norm(left, config_.speed_max_rad_per_s * dt_s)) * goal_.rotation;
}

double Mapping::handle_offset_m(const Vector3& n, double offset_m) const {
  return n.dot(x_ref_) + (offset_m - n.dot(g_ref_)) / scale_;
}

Vector3 Mapping::handle_rotation_at(const Quaternion& goal_rotation) const {
  const Vector3 turn = log_rotation(goal_rotation * q_gref_.conjugate()) / scale_;
  return log_rotation(exp_rotation(turn) * q_ref_);
}

}  // namespace longreach
