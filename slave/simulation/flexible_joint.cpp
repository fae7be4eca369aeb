#include "slave/simulation/flexible_joint.hpp"

#include <cmath>

namespace longreach {
namespace {

// e^(-δt) cos(wt) and e^(-δt) sin(wt)/w of w² = ω² - δ², also where that is negative or zero.
struct Decay {
  double c, s;
};

Decay decay(double omega2, double delta, double t) {
  const double w2 = omega2 - delta * delta, fade = std::exp(-delta * t);
  const double w = std::sqrt(std::abs(w2));
  if (w * t < 1e-6) return {fade, fade * t};
  if (w2 > 0.0) return {fade * std::cos(w * t), fade * std::sin(w * t) / w};
  const double slow = std::exp((w - delta) * t), fast = std::exp(-(w + delta) * t);
  return {0.5 * (slow + fast), 0.5 * (slow - fast) / w};
}

}  // namespace

LinkState swing(const JointConfig& joint, const LinkState& link, const ServoMotion& servo, double torque_nm,
                double dt) {
  const double K = joint.stiffness_nm_per_rad, D = joint.damping_nm_s_per_rad, M = joint.inertia_kg_m2;
  const double pull = K * (servo.rad - link.rad) + D * (servo.rad_per_s - link.rad_per_s) + torque_nm;
  const bool rests = link.rad_per_s == 0.0;
  if (rests && std::abs(pull) <= joint.friction_nm) return link;
  const double sense = std::copysign(1.0, rests ? pull : link.rad_per_s);
  const double offset = (torque_nm - sense * joint.friction_nm) / K;  // of the link from the servo, at rest
  const double y = link.rad - servo.rad - offset, v = link.rad_per_s - servo.rad_per_s;
  const double omega2 = K / M, delta = 0.5 * D / M;
  const Decay d = decay(omega2, delta, dt);
  LinkState next;
  next.rad = servo.rad + servo.rad_per_s * dt + offset + y * (d.c + delta * d.s) + v * d.s;
  next.rad_per_s = servo.rad_per_s + v * (d.c - delta * d.s) - omega2 * y * d.s;
  if (joint.friction_nm > 0.0 && sense * next.rad_per_s < 0.0) next.rad_per_s = 0.0;
  return next;
}

}  // namespace longreach
