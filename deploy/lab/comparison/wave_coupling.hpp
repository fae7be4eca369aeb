#pragma once
// Wave variables at the slave, the mirror image of those at the master: the incoming wave u_s drives a damped
// mass, and the wave w_s is sent back.
//
//   F_s = √(2b) u_s - b v_s,   w_s = √(2b) v_s - u_s,   so  F_s v_s = (u_s² - w_s²)/2
//   m a = F_s - Bs v_s + F_e       the damping is integrated implicitly
//
// A wave that does not arrive is treated as zero.

#include <cmath>

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/coupling_port.hpp"

namespace longreach {

class WaveCoupling {
 public:
  explicit WaveCoupling(const ComparisonConfig& config)
      : config_(config), root_(std::sqrt(2.0 * config.wave_n_s_per_m)) {}

  CouplingOutput step(const CouplingInput& in, double dt_s) {
    const Vector3 at_m = x_m_;
    const Vector3 u = in.command ? in.command->wave : Vector3::Zero().eval();
    const double damping = config_.wave_n_s_per_m + config_.slave_n_s_per_m;
    v_ = (config_.slave_mass_kg * v_ + dt_s * (root_ * u + in.force_n)) /
         (config_.slave_mass_kg + dt_s * damping);
    x_m_ += dt_s * v_;
    return {.setpoint_m = x_m_,
            .report = {.position_m = at_m, .force_n = in.force_n, .wave = root_ * v_ - u}};
  }

 private:
  ComparisonConfig config_;
  double root_;  // √(2b)
  Vector3 x_m_ = Vector3::Zero();
  Vector3 v_ = Vector3::Zero();
};

}  // namespace longreach
