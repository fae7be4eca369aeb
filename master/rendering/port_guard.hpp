#pragma once
// The last stage before the motors for one port, the translational or the rotational handle. It monitors the
// energy at the port and keeps it passive, limits the force and its rate, and ramps it to zero.
//
// Port energy is summed exactly as the motors deliver it, with the force held over a sample:
//   E_port += -f[k-1] . (x[k] - x[k-1])      (positive: from the hand into the device)
// A spring held for a sample acts like negative damping K T/2. If E_port - E_stored therefore decreases and
// the tank is empty, the deficit is repaid by injected damping of at most 0.4 m/T with m the handle alone
// (Hannaford and Ryu 2002, bounded), within the limits of force and rate. Damping computed from single
// encoder counts would supply energy to the handle; the velocity is therefore that of
// quantized_motion_filter.hpp. Force in N and motion in m, or N m and rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct PortGuardConfig {
  double handle_mass = 0.2;  // kg, or kg m²
  double force_max = 15.0;
  double slew_per_s = 5000.0;  // maximum rate of the force, N/s
  double ramp_s = 0.05;
  double freed_damping =
      0.0;  // of a hand whose contact has just ended by a stop, a change of mode or the clutch, N s/m
};

/// Commanded force in this tick.
struct PortForce {
  Vector3 rendered = Vector3::Zero();  // ramps to zero when disengaged
  Vector3 always = Vector3::Zero();    // does not
  Vector3 rate = Vector3::Zero();      // of the handle, as far as it is certain
  bool live = false;
};

class PortGuard {
 public:
  explicit PortGuard(const PortGuardConfig& config) : config_(config) {}
  void configure(const PortGuardConfig& config) { config_ = config; }
  /// Resets the energy balance. The next force starts from the present force.
  void reset();
  void open() { gain_ = 1.0; }  // after reset, with all springs at rest

  /// Energy that entered the port since the last tick, J, by the motion `moved`. Call it once per tick,
  /// before the new force.
  double observe(const Vector3& moved);

  /// The contact force ends although the hand may still press: damping slows the hand down.
  void free_hand() { freed_s_ = kFreed_s; }

  /// Repays the deficit from `energy_j` >= 0 that was dissipated; returns the remainder.
  double repay(double energy_j);
  /// Records `energy_j` >= 0 that leaked and that no tank could supply.
  void owe(double energy_j) {
    deficit_j_ += energy_j;
    deficit_max_j_ = std::max(deficit_max_j_, deficit_j_);
  }

  /// Returns the force on the hand with injected damping, ramp and limits. It is always finite.
  Vector3 apply(const PortForce& force, double dt_s);

  /// Share of `rendered` that was applied in the last tick.
  [[nodiscard]] double gain() const { return gain_; }
  [[nodiscard]] double port_energy_j() const { return port_energy_j_; }
  /// maximum decrease of E_port - E_stored
  [[nodiscard]] double deficit_max_j() const { return deficit_max_j_; }
  [[nodiscard]] bool injecting() const { return injecting_; }
  [[nodiscard]] bool clamped() const { return clamped_; }

 private:
  static constexpr double kFreed_s = 0.6;

  PortGuardConfig config_;
  Vector3 f_last_ = Vector3::Zero();   // force whose work is recorded
  Vector3 f_given_ = Vector3::Zero();  // present force on the hand
  double port_energy_j_ = 0.0;
  double deficit_j_ = 0.0;
  double deficit_max_j_ = 0.0;
  double gain_ = 0.0;
  double freed_s_ = 0.0;  // remaining time of the damping after a release
  bool injecting_ = false;
  bool clamped_ = false;
};

}  // namespace longreach
