#pragma once
// Position-position coupling at the slave: a spring pulls a damped mass to the delayed position of the
// handle.
//
//   m a = Kc (x_m[k-d] - x_s) - Bs v_s + F_e       the damping is integrated implicitly

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/coupling_port.hpp"

namespace longreach {

class SpringCoupling {
 public:
  explicit SpringCoupling(const ComparisonConfig& config) : config_(config) {}

  CouplingOutput step(const CouplingInput& in, double dt_s) {
    const Vector3 at_m = x_m_;
    if (in.command) goal_m_ = in.command->position_m;
    const Vector3 push_n = config_.coupling_n_per_m * (goal_m_ - x_m_) + in.force_n;
    v_ = (config_.slave_mass_kg * v_ + dt_s * push_n) /
         (config_.slave_mass_kg + dt_s * config_.slave_n_s_per_m);
    x_m_ += dt_s * v_;
    return {.setpoint_m = x_m_, .report = {.position_m = at_m, .force_n = in.force_n}};
  }

 private:
  ComparisonConfig config_;
  Vector3 goal_m_ = Vector3::Zero();
  Vector3 x_m_ = Vector3::Zero();
  Vector3 v_ = Vector3::Zero();
};

}  // namespace longreach
