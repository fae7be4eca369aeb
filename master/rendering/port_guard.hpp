#pragma once
// The last stage before the motors: watches the energy at the hand's port and keeps it passive, limits the
// force and ramps it away.
//
// Port energy is summed exactly as the motors deliver it, with the force held over a sample:
//   E_port += -f[k-1] . (x[k] - x[k-1])      (positive: from the hand into the device)
// A spring held for a sample acts like negative damping K T/2; where E_port - E_stored falls for that reason
// and the tank cannot pay, the deficit is paid back by injected damping, at most 0.4 m/T with m the handle
// alone (Hannaford and Ryu 2002, bounded).

#include <algorithm>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct PortGuardConfig {
  double handle_mass_kg = 0.2;
  double force_max_n = 15.0;
  double moment_max_nm = 0.3;
  double ramp_s = 0.05;
};

class PortGuard {
 public:
  explicit PortGuard(const PortGuardConfig& config) : config_(config) {}
  void configure(const PortGuardConfig& config) { config_ = config; }
  void reset(const Vector3& x_m);

  /// Energy that entered the port since the last tick, J; `x_m` finite. Call once a tick, before the new
  /// force.
  double observe(const Vector3& x_m);

  /// Pays the deficit from `energy_j` >= 0 that was dissipated; returns what is left.
  double repay(double energy_j);
  /// Books `energy_j` >= 0 that leaked and that no tank could pay.
  void owe(double energy_j) {
    deficit_j_ += energy_j;
    deficit_max_j_ = std::max(deficit_max_j_, deficit_j_);
  }

  /// Final wrench on the hand: `F` with injected damping and ramp (`live` false: towards zero), `always`
  /// without, limits on their sum. Never non-finite.
  Wrench apply(const Wrench& F, const Wrench& always, const Vector3& velocity_m_per_s, bool live,
               double dt_s);

  [[nodiscard]] double port_energy_j() const { return port_energy_j_; }
  [[nodiscard]] double port_energy_min_j() const { return port_energy_min_j_; }
  [[nodiscard]] double deficit_max_j() const { return deficit_max_j_; }  // largest fall of E_port - E_stored
  [[nodiscard]] bool injecting() const { return injecting_; }
  [[nodiscard]] bool force_clamped() const { return force_clamped_; }
  void open() { gain_ = 1.0; }  // after reset, when every spring is at rest

 private:
  PortGuardConfig config_;
  Vector3 x_last_ = Vector3::Zero();
  Vector3 f_last_ = Vector3::Zero();
  double port_energy_j_ = 0.0;
  double port_energy_min_j_ = 0.0;
  double deficit_j_ = 0.0;
  double deficit_max_j_ = 0.0;
  double gain_ = 0.0;
  bool injecting_ = false;
  bool force_clamped_ = false;
};

}  // namespace longreach
