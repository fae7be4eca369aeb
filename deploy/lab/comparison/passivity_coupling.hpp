#pragma once
// Time-domain passivity control at the slave: the tool moves to the delayed position of the handle as far as
// the energy that entered at the master permits.
//
//   observer    E_out += max(e, 0), E_in += max(-e, 0),  e = -(F_e[k-1] + F_e[k])/2 · (x_s[k] - x_s[k-1])
//   controller  a step costs -F_e·dx and may cost at most E_in,master[k-d] - E_out; the remainder is dropped
//   drift       the dropped motion is recovered at a limited speed as soon as the energy permits
//
// E_out exceeds the energy that entered by at most the increase of the force in one step, times the length of
// the step.

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/coupling_port.hpp"

namespace longreach {

class PassivityCoupling {
 public:
  explicit PassivityCoupling(const ComparisonConfig& config) : speed_max_(config.slave_speed_max_m_per_s) {}

  CouplingOutput step(const CouplingInput& in, double dt_s) {
    if (in.command) far_ = *in.command;
    const double cost_j = -0.5 * (force_n_ + in.force_n).dot(step_m_);
    (cost_j > 0.0 ? out_j_ : in_j_) += std::abs(cost_j);
    force_n_ = in.force_n;
    const Vector3 at_m = x_m_;
    step_m_ =
        paid_step(limited_step(far_.position_m - x_m_, speed_max_ * dt_s), force_n_, far_.energy_j - out_j_);
    x_m_ += step_m_;
    return {.setpoint_m = x_m_, .report = {.position_m = at_m, .force_n = in.force_n, .energy_j = in_j_}};
  }

  [[nodiscard]] double entered_j() const { return in_j_; }
  [[nodiscard]] double left_j() const { return out_j_; }

 private:
  double speed_max_;  // m/s
  ComparisonCommand far_{};
  Vector3 x_m_ = Vector3::Zero();
  Vector3 step_m_ = Vector3::Zero();
  Vector3 force_n_ = Vector3::Zero();
  double in_j_ = 0.0;
  double out_j_ = 0.0;
};

}  // namespace longreach
