#pragma once
// Wave variables (Niemeyer, Slotine 1991).
//
//   u_m = √(2b) v_m - w_m,   F_m = -(b v_m - √(2b) w_m),   so  -F_m v_m = (u_m² - w_m²)/2
//
// The link between two such ends stores energy and cannot create any, at any delay. A missing wave counts as
// zero: its energy is lost, and the tool drifts relative to the handle (the drift is not corrected here). The
// wall is displayed in series with a spring of stiffness b/(one-way delay).

#include <cmath>

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/comparison_port.hpp"

namespace longreach {

class WaveLaw {
 public:
  explicit WaveLaw(const ComparisonConfig& config)
      : impedance_(config.wave_n_s_per_m), root_(std::sqrt(2.0 * config.wave_n_s_per_m)) {}

  ComparisonOutput step(const ComparisonInput& in, double /*dt_s*/) const {
    const Vector3 w = in.report ? in.report->wave : Vector3::Zero().eval();
    const Vector3& v = in.velocity_m_per_s;
    return {.force_n = root_ * w - impedance_ * v,
            .command = {.position_m = in.position_m, .wave = root_ * v - w}};
  }

 private:
  double impedance_;  // b, N s/m
  double root_;       // √(2b)
};

}  // namespace longreach
