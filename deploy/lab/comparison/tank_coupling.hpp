#pragma once
// Energy tank at the slave: the tool moves to the delayed position of the handle as far as the energy H in
// the tank permits.
//
//   H += (F_e[k-1] + F_e[k])/2 · (x_s[k] - x_s[k-1]) + received - sent,   sent = share · H · T
//
// H falls below zero by at most the increase of the force in one step, times the length of the step.

#include <algorithm>

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/coupling_port.hpp"

namespace longreach {

class TankCoupling {
 public:
  explicit TankCoupling(const ComparisonConfig& config) : config_(config) {}

  CouplingOutput step(const CouplingInput& in, double dt_s) {
    level_j_ += 0.5 * (force_n_ + in.force_n).dot(step_m_);
    if (in.command) {
      level_j_ += std::max(0.0, in.command->energy_j - far_.energy_j);
      far_ = *in.command;
    }
    const double quantum_j = std::max(0.0, level_j_) * config_.tank_share_per_s * dt_s;
    level_j_ -= quantum_j;
    sent_j_ += quantum_j;
    force_n_ = in.force_n;
    const Vector3 at_m = x_m_;
    step_m_ = paid_step(limited_step(far_.position_m - x_m_, config_.slave_speed_max_m_per_s * dt_s),
                        force_n_, level_j_);
    x_m_ += step_m_;
    return {.setpoint_m = x_m_, .report = {.position_m = at_m, .force_n = in.force_n, .energy_j = sent_j_}};
  }

  [[nodiscard]] double level_j() const { return level_j_; }

 private:
  ComparisonConfig config_;
  ComparisonCommand far_{};
  Vector3 x_m_ = Vector3::Zero();
  Vector3 step_m_ = Vector3::Zero();
  Vector3 force_n_ = Vector3::Zero();
  double level_j_ = 0.0;
  double sent_j_ = 0.0;
};

}  // namespace longreach
