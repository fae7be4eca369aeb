#pragma once
// Master side of time-domain passivity control for a two-port (Ryu, Artigas, Preusche 2010): force reflection
// with a passivity observer and a passivity controller.
//
//   P = -F v (into the port),  E_in = Σ max(P, 0) T,  E_out = Σ max(-P, 0) T,   F = F_e[k-d]
//   W = E_in,slave[k-d] - E_out + E_pc;  W < 0:  F -= α v,  α = min(-W/(T v²), 2m/T),  E_pc += α v² T
//
// The energy that leaves this port, minus the dissipated energy, never exceeds the energy that entered at the
// slave, except for energy whose dissipation is postponed by the bound on α. The slave corrects the position
// drift.

#include "deploy/lab/comparison/comparison_config.hpp"
#include "deploy/lab/comparison/comparison_port.hpp"

namespace longreach {

class PassivityLaw {
 public:
  explicit PassivityLaw(const ComparisonConfig& config) : handle_mass_kg_(config.handle_mass_kg) {}

  ComparisonOutput step(const ComparisonInput& in, double dt_s);

  [[nodiscard]] double entered_j() const { return in_j_; }
  [[nodiscard]] double left_j() const { return out_j_ - dissipated_j_; }

 private:
  double handle_mass_kg_;
  ComparisonReport far_{};
  double in_j_ = 0.0;
  double out_j_ = 0.0;
  double dissipated_j_ = 0.0;
};

}  // namespace longreach
