#include "master/rendering/resistance.hpp"

namespace longreach {

void Resistance::reset(const HandleState& handle) {
  x_last_ = handle.p_MH;
  stretch_m_.setZero();
  energy_j_ = rotation_energy_j_ = 0.0;
}

Wrench Resistance::step(const ResistanceInput& input) {
  const HandleState& h = input.handle;
  Wrench F;
  if (input.mode == MotionMode::kRate) {
    const Vector3 deflection = h.p_MH - input.centre_m;
    F.force =
        -config_.rate_stiffness_n_per_m * deflection - config_.rate_damping_n_s_per_m * h.velocity_m_per_s;
    energy_j_ = 0.5 * config_.rate_stiffness_n_per_m * deflection.squaredNorm();
    stretch_m_.setZero();
  } else {
    const double sigma = config_.friction_stiffness_n_per_m;
    const double slip_m = config_.friction_n / (input.scale * sigma);
    stretch_m_ = clamp_norm(stretch_m_ + (h.p_MH - x_last_), slip_m);
    F.force = -sigma * stretch_m_;
    energy_j_ = 0.5 * sigma * stretch_m_.squaredNorm();
  }
  x_last_ = h.p_MH;
  rotation_energy_j_ = 0.5 * config_.rotational_stiffness_nm_per_rad * log_rotation(h.q_MH).squaredNorm();
  F.moment = -config_.rotational_stiffness_nm_per_rad * log_rotation(h.q_MH) -
             config_.rotational_damping_nm_s_per_rad * h.angular_rad_per_s;
  return F;
}

}  // namespace longreach
