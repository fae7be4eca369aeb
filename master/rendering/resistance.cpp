#include "master/rendering/resistance.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kCount = 1e-5;    // m or rad; about the resolution of an encoder
constexpr double kNothing = 1e-7;  // m or rad

/// Moves `present` slowly to a smaller target and immediately to a larger one.
double fade(double present, double target, double share) {
  return std::max(target, present + share * (target - present));
}

/// Returns the largest fraction, at most 1, of `step` for which |stretch + fraction · step|² exceeds
/// |stretch|² by at most `gain`.
double affordable(const Vector3& stretch, const Vector3& step, double gain) {
  const double along = stretch.dot(step), length2 = step.squaredNorm();
  if (length2 <= 0.0) return 1.0;
  const double root = std::sqrt(along * along + length2 * gain);
  const double part = along > 0.0 ? gain / (along + root) : (root - along) / length2;
  return std::min(part, 1.0);
}

}  // namespace

Vector3 ElasticResistance::step(const Motion& motion, const Gains& gains, double dt_s) {
  const double share = -std::expm1(-dt_s / gains.fade_s);
  const Vector3 elastic = spring(motion, gains, share) + friction(motion.moved, gains, share);
  damping_ += share * (gains.damping - damping_);
  drag_ = -damping_ * motion.rate;
  return elastic + drag_;
}

Vector3 ElasticResistance::spring(const Motion& motion, const Gains& gains, double share) {
  const bool slack = stretch_.isZero(0.0);
  if (slack) spring_ = gains.spring;
  attached_ = attached_ && motion.centre == centre_;
  centre_ = motion.centre;
  const Vector3 carried = slack ? stretch_ : Vector3(stretch_ + motion.moved);
  if (centre_ == Centre::kNone) {
    const double length = (1.0 - share) * stretch_.norm();
    stretch_ = length < kNothing ? Vector3(Vector3::Zero()) : clamp_norm(carried, length);
  } else if (attached_) {
    stretch_ = motion.deflection;
  } else {
    follow(carried, motion, share);
  }
  if (gains.spring > spring_) {
    stretch_ *= spring_ / gains.spring;  // the same force with less energy
    attached_ = false;
  }
  spring_ = fade(spring_, gains.spring, share);
  return -spring_ * stretch_;
}

void ElasticResistance::follow(const Vector3& carried, const Motion& motion, double share) {
  const Vector3 left = motion.deflection - carried;
  const double paid_j = std::max(0.0, -drag_.dot(motion.moved));
  const double part = spring_ > 0.0 ? affordable(carried, left, 2.0 * paid_j / spring_) : 1.0;
  attached_ = part >= 1.0 && left.norm() <= kCount;
  stretch_ = attached_ ? motion.deflection : Vector3(carried + std::min(part, share) * left);
}

Vector3 ElasticResistance::friction(const Vector3& moved, const Gains& gains, double share) {
  friction_ = fade(friction_, gains.friction, share);
  friction_stiffness_ = gains.friction_stiffness;
  bristle_ = clamp_norm(bristle_ + moved, friction_ / friction_stiffness_);
  return -friction_stiffness_ * bristle_;
}

double ElasticResistance::energy_j() const {
  return 0.5 * spring_ * stretch_.squaredNorm() + 0.5 * friction_stiffness_ * bristle_.squaredNorm();
}

void Resistance::reset(const HandleState& handle) {
  translation_ = rotation_ = {};
  x_last_ = handle.p_MH;
  q_last_ = handle.q_MH;
}

Wrench Resistance::step(const ResistanceInput& input, double dt_s) {
  using Centre = ElasticResistance::Centre;
  const HandleState& h = input.handle;
  const bool rate = input.mode == MotionMode::kRate;
  const bool home = !rate && config_.home_spring;
  const Centre centre = home ? Centre::kHome : rate && !input.frozen ? Centre::kRate : Centre::kNone;
  const Vector3 centre_m = home ? Vector3(Vector3::Zero()) : input.centre_m;
  const Quaternion centre_q = home ? Quaternion::Identity() : input.centre_rotation;
  const double load = input.load ? config_.load_factor : 1.0;
  Wrench F;
  F.force = translation_.step({h.p_MH - x_last_, h.velocity_m_per_s, h.p_MH - centre_m, centre},
                              {.spring = load * config_.rate_stiffness_n_per_m,
                               .damping = rate || home ? config_.rate_damping_n_s_per_m : 0.0,
                               .friction = rate ? 0.0 : config_.friction_n / input.scale,
                               .friction_stiffness = config_.friction_stiffness_n_per_m,
                               .fade_s = config_.fade_s},
                              dt_s);
  x_last_ = h.p_MH;
  if (!input.turns) return F;
  Vector3 deflection_rad = Vector3::Zero();
  if (centre != Centre::kNone) deflection_rad = log_rotation(h.q_MH * centre_q.conjugate());
  F.moment = rotation_.step(
      {log_rotation(h.q_MH * q_last_.conjugate()), h.angular_rad_per_s, deflection_rad, centre},
      {.spring = load * config_.rotational_stiffness_nm_per_rad,
       .damping = config_.rotational_damping_nm_s_per_rad,
       .friction = rate ? 0.0 : config_.friction_nm / input.scale,
       .friction_stiffness = config_.friction_stiffness_nm_per_rad,
       .fade_s = config_.fade_s},
      dt_s);
  q_last_ = h.q_MH;
  return F;
}

}  // namespace longreach
