#pragma once
// Position-position coupling: each side is attracted to the delayed position of the other.
//
//   F_m = -Kc (x_m - x_s[k-d]) - B v_m
//
// The coupling is stable only if 4 Bm Bs > (T1² + T2²) Kc², where Bm and Bs are the total damping of master
// and slave. There is no force before the first report.

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/comparison_port.hpp"

namespace longreach {

class PositionPositionLaw {
 public:
  explicit PositionPositionLaw(const ComparisonConfig& config)
      : stiffness_(config.coupling_n_per_m), damping_(config.coupling_n_s_per_m) {}

  ComparisonOutput step(const ComparisonInput& in, double /*dt_s*/) {
    if (in.report) far_m_ = in.report->position_m;
    ComparisonOutput out{.command = {.position_m = in.position_m}};
    if (far_m_) out.force_n = -stiffness_ * (in.position_m - *far_m_) - damping_ * in.velocity_m_per_s;
    return out;
  }

 private:
  double stiffness_;  // Kc, N/m
  double damping_;    // B, N s/m
  std::optional<Vector3> far_m_{};
};

}  // namespace longreach
