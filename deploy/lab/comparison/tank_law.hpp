#pragma once
// Master side of the two-layer approach with an energy tank (Franken, Stramigioli, Misra, Secchi, Macchelli
// 2011): the force F_e[k-d] of the transparency layer is applied only while the tank contains energy.
//
//   H += -F[k-1] (x[k] - x[k-1]) + received - sent,   sent = share · H · T
//   F = s F_e[k-d] - d v,   d = α max(0, H_level - H) <= m/T
//   s = 0 where H <= 0, and 1 where H is at least a tenth of the level
//
// H falls below zero by at most the energy of one held sample.

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/comparison_port.hpp"

namespace longreach {

class TankLaw {
 public:
  explicit TankLaw(const ComparisonConfig& config) : config_(config) {}

  ComparisonOutput step(const ComparisonInput& in, double dt_s);

  [[nodiscard]] double level_j() const { return level_j_; }

 private:
  ComparisonConfig config_;
  ComparisonReport far_{};
  Vector3 force_n_ = Vector3::Zero();
  double level_j_ = 0.0;
  double sent_j_ = 0.0;
};

}  // namespace longreach
